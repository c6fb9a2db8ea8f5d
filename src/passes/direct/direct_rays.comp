// Irradiance straight from the lights at every visible surface, by a shadow ray to each light: shadows are exact to
// the triangle, and lights need no shadow maps.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/direct/direct_params.h"
#include "shaders/lights.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D face;
layout(set = 0, binding = 3) readonly buffer LightBuffer { GpuLight data[]; } lights;
layout(set = 0, binding = 4) uniform sampler2D sampled;
layout(set = 0, binding = 5, rgba32f) writeonly uniform image2D irradiance;

#include "shaders/trace.glsl"

#include "shaders/lights.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/receiver.glsl"

// To the light from `start`. A light that stands on a surface, or a hair behind it, shines all the same.
Ray shadow_ray(GpuLight light, vec3 start) {
  const float kLightClearance = 1e-4;  // of the distance
  if (light.type == kLightDirectional) return Ray(start, 0.0, -light.direction, kFarAway);
  return Ray(start, 0.0, light.position - start, 1.0 - kLightClearance);
}

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 p = texelFetch(position, ivec2(pixel), 0);
  Receiver receiver = make_receiver(p, texelFetch(normal, ivec2(pixel), 0).xyz,
                                    from_octahedron(texelFetch(face, ivec2(pixel), 0).xy), params.clearance);
  vec3 sum = params.has_sampled != 0 ? texelFetch(sampled, ivec2(pixel), 0).rgb : vec3(0.0);
  for (uint i = 0; i < (p.w > 0.0 ? params.light_count : 0); ++i) {
    GpuLight light = lights.data[i];
    vec3 to_light;
    vec3 e = unshadowed_irradiance(light, p.xyz, to_light);
    e *= cosine_above(receiver, to_light);
    if (e != vec3(0.0)) sum += is_blocked(shadow_ray(light, receiver.start)) ? vec3(0.0) : e;
  }
  imageStore(irradiance, ivec2(pixel), vec4(sum, 1.0));
}
