// Beside the mean of a signal over frames, the variance of its luminance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/noise_filter/noise_filter_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D mean;  // w: frames in it
layout(set = 0, binding = 3) uniform sampler2D mean_square;  // of the luminance
layout(set = 0, binding = 4, rgba32f) writeonly uniform image2D estimate;  // w: variance

// How samples of a pixel's frames relate: stratified along one edge, or as good as independent.
layout(constant_id = 1) const bool kIndependent = false;

#include "passes/noise_filter/same_surface.glsl"
#include "shaders/luminance.glsl"
#include "shaders/software_drivers.glsl"

// Luminance at `tap`, and how far it shows the surface at `here`.
vec2 weighted_luminance(ivec2 tap, vec4 here, vec3 n) {
  if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(params.size)))) return vec2(0.0);
  float exponent = log_same_surface(here.xyz, n, texelFetch(position, tap, 0), 2.0 * params.pixel_tangent * here.w);
  return vec2(luminance(texelFetch(mean, tap, 0).rgb), exp(exponent));
}

// Over every other pixel of 5x5 (after Schied et al. 2017, Sec. 4.2).
float variance_over_square(ivec2 pixel, vec4 here, vec3 n, bool wanted) {
  vec3 sums = vec3(0.0);  // of weights, values, squares
  for (int i = 0; i < LW_ROUNDS_IF(wanted, 13); ++i) {
    vec2 there = weighted_luminance(pixel + ivec2(2 * i % 5, 2 * i / 5) - 2, here, n);
    sums += there.y * vec3(1.0, there.x, there.x * there.x);
  }
  float average = sums.y / max(sums.x, 1e-6);
  return max(sums.z / max(sums.x, 1e-6) - average * average, 0.0);
}

// Of a pixel about the middle between opposite neighbours, which an even slope does not change. The middle's own
// variance is half a pixel's.
float variance_about_slope(ivec2 pixel, vec4 here, vec3 n, float value, bool wanted) {
  const ivec2 kOffsets[4] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
  vec2 sums = vec2(0.0);  // of weights, squares
  for (int i = 0; i < LW_ROUNDS_IF(wanted, 4); ++i) {
    vec2 a = weighted_luminance(pixel + kOffsets[i], here, n);
    vec2 b = weighted_luminance(pixel - kOffsets[i], here, n);
    float difference = value - 0.5 * (a.x + b.x);
    sums += a.y * b.y * vec2(1.0, difference * difference);
  }
  return sums.y / max(1.5 * sums.x, 1e-6);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.size)))) return;
  const float kFramesThatKnow = 4.0;
  vec4 here = texelFetch(position, pixel, 0);
  vec3 n = texelFetch(normal, pixel, 0).xyz;
  vec4 known = texelFetch(mean, pixel, 0);
  float frames = max(known.w, 1.0);

  // The mean of n stratified samples that an edge of shadow divides has a variance of n^-3/2 (Mitchell 1996). Without an
  // edge it has far less, which shows in how well neighbours agree. Independent ones: n^-1. Few frames know nothing of
  // their own.
  float value = luminance(known.rgb);
  float rate = kIndependent ? 1.0 : inversesqrt(frames);
  float own = max(texelFetch(mean_square, pixel, 0).x - value * value, 0.0) * rate / frames;
  bool visible = here.w > 0.0;
  bool few = frames < kFramesThatKnow;
  float few_variance = variance_over_square(pixel, here, n, visible && few);
  float many_variance = min(own, variance_about_slope(pixel, here, n, value, visible && !few));
  float variance = few ? mix(few_variance, own, (frames - 1.0) / kFramesThatKnow) : many_variance;
  imageStore(estimate, pixel, vec4(known.rgb, variance));
}
