// One round of merging, second step: how many clusters each block keeps and how many pairs it merges.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer StateBuffer { uint data[]; } state;
LW_PAGED_READ(0, 1, uint, partners)
layout(set = 0, binding = 2) writeonly buffer BlockBuffer { uvec2 data[]; } blocks;  // kept, merged

#include "shaders/linear_dispatch.glsl"

void main() {
  uint block = linear_invocation();
  uint count = state.data[kBvhClusters];
  uint first = block * kBvhPairBlock;
  if (first >= count) return;
  uint end = min(first + kBvhPairBlock, count);
  uvec2 sum = uvec2(0);
  for (uint i = first; i < end; ++i) {
    uint partner = partners_at(i);
    bool mutual = partner != i && partners_at(partner) == i;
    sum += uvec2(mutual && partner < i ? 0 : 1, mutual && i < partner ? 1 : 0);
  }
  blocks.data[block] = sum;
}
