// The geometry-aware box filter of the paper: neighbours count whose position and normal are near (Laine et al. 2007).
// Over 5 x 5 pixels, the outermost with half the weight: each of the 16 parts of the light then counts alike.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/many_light/many_light_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
LW_PUSH_CONSTANTS(PaperFilterParams, LW_PAPER_FILTER_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D merged;
layout(set = 0, binding = 3, rgba32f) writeonly uniform image2D filtered;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.size)))) return;
  vec4 here = texelFetch(position, pixel, 0);
  vec3 n = texelFetch(normal, pixel, 0).xyz;
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int y = -2; y <= 2; ++y) {
    for (int x = -2; x <= 2; ++x) {
      ivec2 tap = pixel + ivec2(x, y);
      if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(params.size)))) continue;
      vec4 there = texelFetch(position, tap, 0);
      bool counts = there.w > 0.0 && distance(here.xyz, there.xyz) <= params.most_distance &&
                    dot(n, texelFetch(normal, tap, 0).xyz) >= params.least_cosine;
      float weight = counts ? (abs(x) == 2 ? 0.5 : 1.0) * (abs(y) == 2 ? 0.5 : 1.0) : 0.0;
      sum += weight * texelFetch(merged, tap, 0).rgb;
      weights += weight;
    }
  }
  imageStore(filtered, pixel, vec4(here.w > 0.0 && weights > 0.0 ? sum / weights : vec3(0.0), 1.0));
}
