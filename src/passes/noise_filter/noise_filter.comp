// One round of an edge-aware filter of wavelet kind ("a trous", Dammertz et al. 2010). Its taps lie along the diagonals and
// along the axes by turns: four rounds of 4 leave less noise than three of 3x3. A neighbour counts as far as it belongs
// to the same surface and its light differs by no more than the noise of both (after Schied et al. 2017): as the
// variance falls, the filter fades.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/noise_filter/noise_filter_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D source;  // w: variance of the luminance
layout(set = 0, binding = 3, rgba32f) writeonly uniform image2D target;

// 1: every pixel keeps what its neighbours do not take, and the sum of all stays what it was, however skewed the noise.
// 0: the mean of what belongs together.
layout(constant_id = 0) const bool kKeepsLight = false;

#include "passes/noise_filter/same_surface.glsl"
#include "shaders/luminance.glsl"
#include "shaders/software_drivers.glsl"

// Of a pixel's luminance: less noise than this is left alone.
const float kInvisible = 0.005;

// Standard deviations by which two pixels of the same light may differ.
const float kTolerance = 2.0;

const ivec2 kOffsets[8] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, 1}, {-1, 1}, {1, -1}};

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.size)))) return;
  vec4 here = texelFetch(position, pixel, 0);
  vec3 n = texelFetch(normal, pixel, 0).xyz;
  vec4 own = texelFetch(source, pixel, 0);
  float own_luminance = luminance(own.rgb);
  float spacing = params.pixel_tangent * here.w * float(params.step);

  vec4 sum = own;
  float weights = 1.0;
  // Black has no variance of its own: here no ray may have found light that neighbours' rays did find.
  bool noisy = own_luminance == 0.0 || sqrt(own.w) > kInvisible * own_luminance;
  for (int i = 0; i < LW_ROUNDS_IF(here.w > 0.0 && noisy, 4); ++i) {
    ivec2 tap = pixel + params.step * kOffsets[4 * params.diagonal + i];
    if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(params.size)))) continue;
    vec4 there = texelFetch(source, tap, 0);
    float deviation = sqrt(own.w + there.w);
    float difference = abs(luminance(there.rgb) - own_luminance);
    float exponent = log_same_surface(here.xyz, n, texelFetch(position, tap, 0), spacing) -
                     difference / (kTolerance * deviation + 1e-6 * own_luminance + 1e-30);
    float weight = exp(exponent);
    sum += vec4(weight * there.rgb, weight * weight * there.w);
    weights += weight;
  }
  if (kKeepsLight) {
    // What a pixel gives to another, it loses: weights are the same both ways, and no pixel's add up to more than 5.
    sum += vec4((4.0 - (weights - 1.0)) * own.rgb, ((5.0 - weights) * (5.0 - weights) + 2.0 * (5.0 - weights)) * own.w);
    weights = 5.0;
  }
  imageStore(target, pixel, vec4(sum.rgb / weights, sum.w / (weights * weights)));
}
