// Numbers that start a path, warped to where its source is important: of all paths one part is spread by importance,
// the other as ever. Kernels declare
//   layout(set = 0, binding = n) readonly buffer GuideBuffer { float data[]; } guide;   // kGuideFloats a source
// and use sources.glsl.
#ifndef LIGHTWELL_LIGHT_PATHS_GUIDE_GLSL
#define LIGHTWELL_LIGHT_PATHS_GUIDE_GLSL

#include "passes/light_paths/light_path_guide.h"

// Mean importance of a source.
float guide_mean(uint source) { return guide.data[source * kGuideFloats + kGuideSide - 1] / float(kGuideStrata); }

// Density of an importance's stratum over that without a guide is x * importance + y; `mean`: of all, by power.
vec2 guide_mixture(float mean) {
  return mean > 0.0 ? vec2((1.0 - kUnguidedPart) / mean, kUnguidedPart) : vec2(0.0, 1.0);
}

struct GuidedNumbers {
  vec2 u;
  uint stratum;
  float density;  // over that without a guide, in this source
};

// The first of the kGuideSide running sums from `begin` on, `each` more an element, that is above `target`.
uint guide_search(uint begin, vec2 mixture, float each, float target) {
  uint low = 0;
  uint high = kGuideSide - 1;
  for (int i = 0; i < 5; ++i) {
    uint middle = (low + high) / 2;
    bool above = mixture.x * guide.data[begin + middle] + float(middle + 1) * each > target;
    low = above || low == high ? low : middle + 1;
    high = above ? middle : high;
  }
  return low;
}

// Chooses an element; `u` becomes its place in [0, 1) of all elements. Gives the part of the sum that it has, times their
// number.
float guide_choose(uint begin, vec2 mixture, float each, inout float u, out uint chosen) {
  float all = mixture.x * guide.data[begin + kGuideSide - 1] + float(kGuideSide) * each;
  float target = u * all;
  chosen = guide_search(begin, mixture, each, target);
  float below = chosen > 0 ? mixture.x * guide.data[begin + chosen - 1] + float(chosen) * each : 0.0;
  float own = mixture.x * guide.data[begin + chosen] + float(chosen + 1) * each - below;
  u = (float(chosen) + clamp((target - below) / max(own, 1e-30), 0.0, 0.999999)) / float(kGuideSide);
  return own / all * float(kGuideSide);
}

GuidedNumbers guided_numbers(uint source, float mean, vec2 u) {
  vec2 mixture = guide_mixture(mean);
  uint begin = source * kGuideFloats;
  uint row, column;
  float density = guide_choose(begin, mixture, mixture.y * float(kGuideSide), u.y, row);
  density *= guide_choose(begin + kGuideSide * (1 + row), mixture, mixture.y, u.x, column);
  return GuidedNumbers(u, source * kGuideStrata + row * kGuideSide + column, density);
}

#endif
