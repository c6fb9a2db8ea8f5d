// One direction of a separable Gaussian filter: binomial coefficients. Pixels without a surface are left out.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/photon_splatting/paper_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
LW_PUSH_CONSTANTS(PaperBlurParams, LW_PAPER_BLUR_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D source;  // w: 1 where there is a surface
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D target;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.size)))) return;
  vec4 sum = vec4(0.0);
  float coefficient = 1.0;
  for (int i = 0; i <= 2 * params.radius; ++i) {
    ivec2 tap = pixel + (i - params.radius) * params.step;
    bool inside = all(greaterThanEqual(tap, ivec2(0))) && all(lessThan(tap, ivec2(params.size)));
    vec4 value = texelFetch(source, clamp(tap, ivec2(0), ivec2(params.size) - 1), 0);
    if (inside) sum += coefficient * value.w * vec4(value.xyz, 1.0);
    coefficient *= float(2 * params.radius - i) / float(i + 1);
  }
  bool seen = texelFetch(source, pixel, 0).w > 0.0;
  imageStore(target, pixel, seen ? vec4(sum.xyz / sum.w, 1.0) : vec4(0.0));
}
