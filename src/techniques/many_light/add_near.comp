// Adds what comes from nearby to the light from farther away: E += factor * (E direct + E of light points) at y.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/many_light/many_light_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
LW_PUSH_CONSTANTS(AddParams, LW_ADD_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D factor;
layout(set = 0, binding = 1) uniform sampler2D near_direct;
layout(set = 0, binding = 2) uniform sampler2D near_indirect;
layout(set = 0, binding = 3) uniform sampler2D far;
layout(set = 0, binding = 4, rgba32f) writeonly uniform image2D sum;
layout(constant_id = 0) const bool kIndirect = true;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.size)))) return;
  vec3 near = texelFetch(near_direct, pixel, 0).rgb;
  if (kIndirect) near += texelFetch(near_indirect, pixel, 0).rgb;
  imageStore(sum, pixel, vec4(texelFetch(far, pixel, 0).rgb + texelFetch(factor, pixel, 0).rgb * near, 1.0));
}
