// Indirect light at the picture's pixels: cosine-distributed rays, each answered where it ends by direct light there, a
// sample of which also goes into the cache, and by the cache's indirect light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/noise_filter/light_change_types.h"
#include "shaders/lights.h"
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 8, local_size_y = 8) in;

#include "shaders/trace.glsl"

#include "passes/light_cache/cache_rays.glsl"

layout(set = 0, binding = 9) uniform sampler2D position;
layout(set = 0, binding = 10) uniform sampler2D normal;
layout(set = 0, binding = 11) uniform sampler2D face;
layout(set = 0, binding = 12, rgba32f) writeonly uniform image2D irradiance;
layout(set = 0, binding = 13, rgba32ui) writeonly uniform uimage2D ends_0;
layout(set = 0, binding = 14, rgba32ui) writeonly uniform uimage2D ends_1;

layout(set = 0, binding = 6) readonly buffer ShownBuffer { vec4 data[]; } shown;
layout(set = 0, binding = 15) readonly buffer IndirectBuffer { vec4 data[]; } indirect;

#include "techniques/ray_traced_voxels/cache_memory.glsl"
#include "passes/light_cache/cache_read.glsl"

RayEnd last_end = kNoRayEnd;  // of this pixel's rays

// W/m^2 of radiosity at the end of the ray.
vec3 radiosity_along(Ray ray, uvec2 pixel, uint index) {
  RayHit hit = trace_closest(ray);
  if (hit.triangle == kNoTriangle) return vec3(0.0);
  Surface surface = surface_at(hit, ray.direction);
  uint level;
  uint met = face_at(params.levels, surface.position, surface.face_normal, kFootprint * hit.t, level);
  if (met != kNoFace) vote(met, kVoteMet, level, surface.position, 0, pixel.x ^ pixel.y << 16 ^ index * 0x9e3779b9u);
  if (kFromLights) return met != kNoFace ? cached_radiosity(met, surface.albedo) : vec3(0.0);
  vec3 direct = direct_at(receiver_at(surface), pixel, index, 1);
  vec3 cached = vec3(0.0);
  if (met != kNoFace) {
    inject(met, direct);
    cached = near_of(met) + indirect.data[met].rgb;
  }
  vec3 all = surface.albedo * (direct + cached);
  last_end = make_ray_end(surface, direct, all);
  return all;
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
  uvec2 block = pixel / kChangeBlock;
  if (pixel == pixel_of_turn(block, params.turn, params.size)) {
    imageStore(ends_0, ivec2(block), first_words(last_end));
    imageStore(ends_1, ivec2(block), last_words(last_end));
  }
}
