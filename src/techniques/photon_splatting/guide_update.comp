// The importance of a source's strata: how many splats of a path that starts there some view sees. A workgroup a source,
// an invocation a row of strata.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_paths/light_path_guide.h"
#include "techniques/photon_splatting/guide_types.h"

layout(local_size_x = 32) in;  // kGuideSide
LW_PUSH_CONSTANTS(GuideUpdateParams, LW_GUIDE_UPDATE_PARAMS)
layout(set = 0, binding = 0) buffer CountBuffer { uvec2 data[]; } counts;  // paths, their splats that views see
layout(set = 0, binding = 1) buffer SumBuffer { vec2 data[]; } sums;       // the same over frames
layout(set = 0, binding = 2) writeonly buffer TableBuffer { float data[]; } table;

shared vec2 row_sums[kGuideSide];
shared float row_importance[kGuideSide];

// Of a path: seen splats, where `expected` a path are as good as so many paths' count. Paths are best spread by the root
// of the mean square of what they bring, and what is seen or not is its own square.
float importance(vec2 sum, float expected, float worth) { return sqrt((sum.y + worth * expected) / (sum.x + worth)); }

void main() {
  uint row = gl_LocalInvocationID.x;
  uint source = gl_WorkGroupID.x;
  uint begin = source * kGuideStrata + row * kGuideSide;
  vec2 row_sum = vec2(0.0);
  for (uint i = 0; i < kGuideSide; ++i) {
    vec2 sum = vec2(0.0);
    if (params.keep > 0.0) sum = params.keep * sums.data[begin + i];
    if (params.counted > 0.0) sum += vec2(counts.data[begin + i]);
    counts.data[begin + i] = uvec2(0);
    sums.data[begin + i] = sum;
    row_sum += sum;
  }
  row_sums[row] = row_sum;
  barrier();
  vec2 source_sum = vec2(0.0);
  for (uint i = 0; i < kGuideSide; ++i) source_sum += row_sums[i];
  // A source or stratum of few paths is like the mean, in which an unknown source has one splat a path.
  float expected = (source_sum.y + 1.0) / (source_sum.x + 1.0);

  const float kWorth = 4.0;  // paths
  uint table_begin = source * kGuideFloats;
  float running = 0.0;
  for (uint i = 0; i < kGuideSide; ++i) {
    running += importance(sums.data[begin + i], expected, kWorth);
    table.data[table_begin + kGuideSide * (1 + row) + i] = running;
  }
  row_importance[row] = running;
  barrier();
  float rows = 0.0;
  for (uint i = 0; i <= row; ++i) rows += row_importance[i];
  table.data[table_begin + row] = rows;
}
