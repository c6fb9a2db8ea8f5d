// One level of the luminance of the reflected flux: of each texel itself, or the sum of the four below.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/rsm/rsm_mips_params.h"
#include "shaders/luminance.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kFinest = false;
layout(set = 0, binding = 0) uniform sampler2D source;
layout(set = 0, binding = 1, r32f) writeonly uniform image2D target;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, ivec2(params.size)))) return;
  float sum;
  if (kFinest) {
    sum = max(luminance(texelFetch(source, texel, 0).rgb), 0.0);
  } else {
    float upper = texelFetch(source, 2 * texel, 0).r + texelFetch(source, 2 * texel + ivec2(1, 0), 0).r;
    float lower = texelFetch(source, 2 * texel + ivec2(0, 1), 0).r + texelFetch(source, 2 * texel + 1, 0).r;
    sum = upper + lower;
  }
  imageStore(target, texel, vec4(sum));
}
