// The mean of a noisy image over frames, each pixel's history fetched from where its surface was last frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/noise_filter/temporal_mean_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D signal;
layout(set = 0, binding = 1) uniform sampler2D motion;
layout(set = 0, binding = 2) uniform usampler2D reprojection;
layout(set = 0, binding = 3) uniform sampler2D last_mean;  // w: frames in it
layout(set = 0, binding = 4) uniform sampler2D last_mean_square;
layout(set = 0, binding = 5, rgba32f) writeonly uniform image2D mean;
layout(set = 0, binding = 6, r32f) writeonly uniform image2D mean_square;  // of the luminance
layout(set = 0, binding = 7) uniform sampler2D limits;  // x: frames that the history counts for, a texel a block

// Whether a pixel counts for as much of a frame as the signal's w says.
layout(constant_id = 0) const bool kWeighted = false;

#include "passes/reprojection/reprojection.glsl"
#include "shaders/luminance.glsl"

struct History {
  vec4 mean;  // w: frames in it
  float mean_square;
};

History fetch_history(Reprojection r) {
  const float kMostInterpolated = 64.0;  // frames: errors of interpolation must fade
  const float kMostBorrowed = 8.0;       // frames: neighbours' light is like this pixel's, but not the same
  History sum = History(vec4(0.0), 0.0);
  float weight = 0.0;
  for (uint taps = params.has_history != 0 ? r.taps : 0; taps != 0; taps &= taps - 1u) {
    HistoryTap tap = history_tap(r.place, findLSB(taps));
    sum.mean += tap.weight * texelFetch(last_mean, tap.texel, 0);
    sum.mean_square += tap.weight * texelFetch(last_mean_square, tap.texel, 0).x;
    weight += tap.weight;
  }
  if (r.borrowed) sum.mean.w = min(sum.mean.w, kMostBorrowed * weight);
  History history = History(weight > 0.0 ? sum.mean / weight : vec4(0.0), weight > 0.0 ? sum.mean_square / weight : 0.0);
  history.mean.w = min(history.mean.w, r.place.still ? params.most_frames : min(params.most_frames, kMostInterpolated));
  return history;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.size)))) return;
  vec4 here = texelFetch(signal, pixel, 0);
  vec3 value = here.rgb;
  float count = kWeighted ? here.w : 1.0;
  float square = luminance(value) * luminance(value);
  History history = fetch_history(load_reprojection(pixel));
  float frames = history.mean.w;
  if (params.limit_block > 0) frames = min(frames, texelFetch(limits, pixel / int(params.limit_block), 0).x);
  float weight = params.blend_factor * count / (frames + params.blend_factor * count);
  imageStore(mean, pixel, vec4(mix(history.mean.rgb, value, weight), frames + count));
  imageStore(mean_square, pixel, vec4(mix(history.mean_square, square, weight)));
}
