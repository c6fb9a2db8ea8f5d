// Beside the mean of sampled light, the variance of its luminance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sampled_lights/filter_light_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D light;  // w: frames in the mean
layout(set = 0, binding = 3) uniform usampler2D surface;
layout(set = 0, binding = 4, rgba32f) writeonly uniform image2D estimate;  // w: variance

#include "passes/sampled_lights/same_surface.glsl"
#include "passes/sampled_lights/surface_history.glsl"
#include "shaders/luminance.glsl"

// Of the luminance over every other pixel of 5x5, as far as they are of one surface: what few frames cannot tell about
// themselves (after Schied et al. 2017, Sec. 4.2).
float variance_among_neighbours(ivec2 pixel, vec4 here, int rounds) {
  vec3 n = texelFetch(normal, pixel, 0).xyz;
  vec3 sums = vec3(0.0);  // of weights, values, squares
  for (int i = 0; i < rounds; ++i) {
    ivec2 tap = pixel + ivec2(2 * i % 5, 2 * i / 5) - 2;
    if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(params.size)))) continue;
    float weight = exp(log_same_surface(here.xyz, n, texelFetch(position, tap, 0), 2.0 * params.pixel_tangent * here.w));
    float value = luminance(texelFetch(light, tap, 0).rgb);
    sums += weight * vec3(1.0, value, value * value);
  }
  if (sums.x <= 0.0) return 0.0;
  float mean = sums.y / sums.x;
  return max(sums.z / sums.x - mean * mean, 0.0);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.size)))) return;
  const float kFramesThatKnow = 8.0;
  vec4 here = texelFetch(position, pixel, 0);
  vec4 mean = texelFetch(light, pixel, 0);
  float frames = max(mean.w, 1.0);

  // The mean of n stratified samples that an edge of shadow divides has a variance of n^-3/2 (Mitchell 1996).
  float value = luminance(mean.rgb);
  float own = max(unpack_surface(texelFetch(surface, pixel, 0)).mean_square - value * value, 0.0) * inversesqrt(frames) / frames;
  bool few = here.w > 0.0 && frames < kFramesThatKnow;
  float variance = few ? mix(variance_among_neighbours(pixel, here, 13), own, (frames - 1.0) / kFramesThatKnow) : own;
  imageStore(estimate, pixel, vec4(mean.rgb, variance));
}
