// Fetches any image of last frame where a pixel's surface was then, so that all histories are rejected alike. The
// including kernel declares, before including this file (host side: read_reprojection()),
//   layout(set = 0, binding = n) uniform sampler2D motion;
//   layout(set = 0, binding = n) uniform usampler2D reprojection;
// and visits the valid taps, whatever the history holds:
//   Reprojection r = load_reprojection(pixel);
//   for (uint taps = r.taps; taps != 0; taps &= taps - 1u) {
//     HistoryTap tap = history_tap(r.place, findLSB(taps));
//     sum += tap.weight * texelFetch(last_image, tap.texel, 0);
//     weight += tap.weight;  // of all valid taps: seldom 1
//   }
#ifndef LIGHTWELL_REPROJECTION_GLSL
#define LIGHTWELL_REPROJECTION_GLSL

#include "passes/reprojection/history_taps.glsl"

struct Reprojection {
  LastPlace place;
  uint taps;      // bit i: tap i is valid; 0: the history is rejected
  bool borrowed;  // from neighbours: their history is like this pixel's, but not the same
};

Reprojection load_reprojection(ivec2 pixel) {
  uint bits = texelFetch(reprojection, pixel, 0).x;
  LastPlace place = last_place(pixel, texelFetch(motion, pixel, 0).xy);
  return Reprojection(place, bits & kTapMask, (bits & kBorrowedBit) != 0);
}

#endif
