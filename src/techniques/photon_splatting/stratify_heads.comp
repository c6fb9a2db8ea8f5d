// Which light points are the first of a bundle: of a cell, or of the largest block round it that has become one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/photon_splatting/photon_types.h"
#include "techniques/photon_splatting/stratify_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer SortedBuffer { uvec2 data[]; } sorted;
layout(set = 0, binding = 1) readonly buffer PointCountBuffer { uint data[]; } point_counts;
layout(set = 0, binding = 2) readonly buffer MergedBuffer { uint data[]; } merged;
layout(set = 0, binding = 3) writeonly buffer FlagBuffer { uint data[]; } flags;

#include "shaders/linear_dispatch.glsl"
#include "techniques/photon_splatting/stratify_cells.glsl"

bool is_head(uint i) {
  if (!is_first(i, 0)) return false;
  uint cell = sorted.data[i].x;
  for (uint level = params.levels; level > 0; --level) {
    uint first = first_in_block(cell, level);
    if ((merged.data[first] & (1u << level)) != 0) return first == i;
  }
  return true;
}

void main() {
  uint i = linear_invocation();
  if (i >= params.point_count) return;
  flags.data[i] = i < point_counts.data[kPointsInAll] && is_head(i) ? 1 : 0;
}
