// Marks the blocks that become one, level by level: those with an occupied part that holds fewer photons than the
// threshold. The marks stand at a block's first light point, bit l for blocks of 2^l cells a side.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/photon_splatting/photon_types.h"
#include "techniques/photon_splatting/stratify_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer SortedBuffer { uvec2 data[]; } sorted;
layout(set = 0, binding = 1) readonly buffer PointCountBuffer { uint data[]; } point_counts;
layout(set = 0, binding = 2) buffer MergedBuffer { uint data[]; } merged;

#include "shaders/linear_dispatch.glsl"
#include "techniques/photon_splatting/stratify_cells.glsl"

void main() {
  uint i = linear_invocation();
  uint count = point_counts.data[kPointsInAll];
  if (i >= count) return;
  uint cell = sorted.data[i].x;
  for (uint level = 0; level < params.levels && is_first(i, level); ++level) {
    uint enough = i + params.threshold - 1;
    if (enough < count && block_of(sorted.data[enough].x, level) == block_of(cell, level)) continue;
    atomicOr(merged.data[first_in_block(cell, level + 1)], 1u << (level + 1));
  }
}
