// From the light of single pixels before and after, for how many frames the history round them may count.
//
// Of n samples that change by d_i each, the square of the sum less the sum of the squares is about the square of what
// changed together: what changes one up, one down at random is noise and no reason to forget. With light that changes by
// the part s a frame, and noise of sigma a frame, the error of a mean over n frames is about
//   (s n / 2)^2 + sigma^2 / n, least at n = (2 sigma^2 / s^2)^(1/3).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/noise_filter/light_change_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kLast = false;
layout(set = 0, binding = 0) uniform sampler2D sums;  // of neighbourhoods, as far as they are made: d, d^2, light
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D filtered;  // last round: x: frames

const float kNoise = 0.1;  // sigma, of the light: about what a filtered frame has

void main() {
  ivec2 block = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(block, ivec2(params.block_count)))) return;
  vec3 sum = vec3(0.0);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      ivec2 tap = clamp(block + params.step * ivec2(x, y), ivec2(0), ivec2(params.block_count) - 1);
      sum += texelFetch(sums, tap, 0).xyz;
    }
  if (kLast) {
    float part = sum.z > 0.0 ? min(sqrt(max(sum.x * sum.x - sum.y, 0.0)) / sum.z, 1.0) : 0.0;
    // Where all is gone, so is the history.
    float frames = pow(2.0 * kNoise * kNoise, 1.0 / 3.0) * (pow(max(part, 1e-6), -2.0 / 3.0) - 1.0);
    sum = vec3(part > 0.95 ? 0.0 : frames, 0.0, 0.0);
  }
  imageStore(filtered, block, vec4(sum, 0.0));
}
