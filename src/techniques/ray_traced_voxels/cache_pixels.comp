// Indirect light at the picture's pixels: cosine-distributed rays, each answered where it ends by direct light there, a
// sample of which also goes into the cache, and by the cache's indirect light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights.h"
#include "techniques/ray_traced_voxels/cache_types.h"

layout(local_size_x = 8, local_size_y = 8) in;

#include "shaders/trace.glsl"

#include "techniques/ray_traced_voxels/cache_rays.glsl"

layout(set = 0, binding = 9) uniform sampler2D position;
layout(set = 0, binding = 10) uniform sampler2D normal;
layout(set = 0, binding = 11) uniform sampler2D face;
layout(set = 0, binding = 12, rgba32f) writeonly uniform image2D irradiance;

// W/m^2 of radiosity at the end of the ray.
vec3 radiosity_along(Ray ray, uvec2 pixel, uint index) {
  RayHit hit = trace_closest(ray);
  if (hit.triangle == kNoTriangle) return vec3(0.0);
  Surface surface = surface_at(hit, ray.direction);
  uint met = face_at(params.grid, surface.position, surface.face_normal);
  if (met != kNoFace) vote(met, surface.position, 0, pixel.x ^ pixel.y << 16 ^ index * 0x9e3779b9u);
  if (kFromLights) return met != kNoFace ? cached_radiosity(met, surface.albedo) : vec3(0.0);
  vec3 direct = direct_at(receiver_at(surface), pixel, index, 1);
  if (met == kNoFace) return surface.albedo * direct;
  inject(met, direct);
  return surface.albedo * (direct + shown.data[met * kShownWords + kShownNear].rgb +
                           shown.data[met * kShownWords + kShownIndirect].rgb);
}

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 place = texelFetch(position, ivec2(pixel), 0);
  vec3 sum = vec3(0.0);
  if (place.w > 0.0) {
    Receiver receiver = make_receiver(place, texelFetch(normal, ivec2(pixel), 0).xyz,
                                      from_octahedron(texelFetch(face, ivec2(pixel), 0).xy), params.clearance);
    mat3 frame = frame_about(receiver.normal);
    for (uint i = 0; i < params.count; ++i) {
      uint index = params.frame * params.count + i;
      vec3 direction = cosine_direction(frame, disk_point(stratified_point(pixel, index, 0)));
      if (cosine_above(receiver, direction) > 0.0)
        sum += radiosity_along(Ray(receiver.start, 0.0, direction, kFarAway), pixel, index);
    }
  }
  imageStore(irradiance, ivec2(pixel), vec4(sum / float(params.count), 1.0));
}
