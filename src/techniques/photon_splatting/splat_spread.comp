// From light at samples to light at pixels: each pixel takes what the four samples round it have, as far as they are on
// its own surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/photon_splatting/splat_view_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
LW_PUSH_CONSTANTS(SplatSpreadParams, LW_SPLAT_SPREAD_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D gathered;  // a texel a sample
layout(set = 0, binding = 3, rgba32f) writeonly uniform image2D light;  // w: weight in the mean over frames

#include "passes/noise_filter/same_surface.glsl"
#include "techniques/photon_splatting/splat_samples.glsl"

// Of light from another surface, where none of the samples is on the pixel's own. It is gone from the mean as soon as
// there is a sample that is.
const float kGuess = 1e-4;

void main() {
  const float kSharpness = 8.0;  // of the cosine between normals
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.samples.size)))) return;
  vec4 here = texelFetch(position, pixel, 0);
  vec3 n = texelFetch(normal, pixel, 0).xyz;
  vec2 place = vec2(pixel - sample_turn()) / float(params.samples.stride);
  vec2 first = floor(place);
  vec2 part = place - first;
  float spacing = params.pixel_tangent * here.w;
  float alike = 0.0, weights = 0.0;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 corner = ivec2(i & 1, i >> 1);
    ivec2 tap = clamp(ivec2(first) + corner, ivec2(0), sample_count() - 1);
    vec2 nearness = mix(1.0 - part, part, vec2(corner));
    vec4 there = texelFetch(position, pixel_of_sample(tap), 0);
    float cosine = max(0.0, dot(n, texelFetch(normal, pixel_of_sample(tap), 0).xyz));
    float like = exp(log_same_surface(here.xyz, n, there, spacing)) * pow(cosine, kSharpness);
    float weight = nearness.x * nearness.y * (there.w > 0.0 ? like + kGuess : 0.0);
    alike += nearness.x * nearness.y * like;
    weights += weight;
    sum += weight * texelFetch(gathered, tap, 0).rgb;
  }
  // Samples on one side of a pixel say less about it than its own does.
  float weight = clamp(alike * alike, kGuess, 1.0);
  imageStore(light, pixel, vec4(here.w > 0.0 && weights > 0.0 ? sum / weights : vec3(0.0), weight));
}
