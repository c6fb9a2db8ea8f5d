// Irradiance straight from the lights at every visible surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/direct/direct_params.h"
#include "shaders/lights.h"
#include "shaders/shadow_view.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) readonly buffer LightBuffer { GpuLight data[]; } lights;
layout(set = 0, binding = 3) readonly buffer ShadowViewBuffer { ShadowView data[]; } shadow_views;
layout(set = 0, binding = 4) uniform sampler2D shadow_atlas;
layout(set = 0, binding = 5) uniform sampler2D sampled;
layout(set = 0, binding = 6, rgba32f) writeonly uniform image2D irradiance;

#include "shaders/direct.glsl"

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 p = texelFetch(position, ivec2(pixel), 0);
  vec3 e = params.has_sampled != 0 ? texelFetch(sampled, ivec2(pixel), 0).rgb : vec3(0.0);
  if (p.w > 0.0) e += direct_irradiance(p.xyz, texelFetch(normal, ivec2(pixel), 0).xyz, params.light_count);
  imageStore(irradiance, ivec2(pixel), vec4(e, 1.0));
}
