// One round of merging, third step: where each block writes, and how large the next round is. When few clusters are left,
// rounds do nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0) buffer BlockBuffer { uvec2 data[]; } blocks;
layout(set = 0, binding = 1) buffer StateBuffer { uint data[]; } state;

#include "shaders/linear_dispatch.glsl"
#include "passes/sort/scan_blocks.glsl"

void set_groups(uint first, uint invocations) {
  uvec3 groups = invocations == 0 ? uvec3(0) : linear_groups((invocations + 63) / 64);
  for (uint i = 0; i < 3; ++i) state.data[first + i] = groups[i];
}

void main() {
  uint count = state.data[kBvhClusters];
  uint half_index = state.data[kBvhHalf];
  uint inner = state.data[kBvhInnerNodes];
  bool active_round = count > kBvhTopClusters;
  uvec2 sum = scan_blocks(active_round ? (count + kBvhPairBlock - 1) / kBvhPairBlock : 0);
  if (gl_LocalInvocationID.x != 0) return;
  uint blocks_before = (count + kBvhPairBlock - 1) / kBvhPairBlock;
  set_groups(kBvhMergeGroups, active_round ? blocks_before : 0);
  set_groups(kBvhRounds + 4 * params.round, sum.y);
  state.data[kBvhRounds + 4 * params.round + 3] = inner;
  state.data[kBvhRounds + 4 * params.round + 7] = inner + sum.y;
  if (active_round) {
    state.data[kBvhOldClusters] = count;
    state.data[kBvhOldHalf] = half_index;
    state.data[kBvhOldInnerNodes] = inner;
    state.data[kBvhClusters] = sum.x;
    state.data[kBvhHalf] = 1 - half_index;
    state.data[kBvhInnerNodes] = inner + sum.y;
  }
  bool goes_on = active_round && sum.x > kBvhTopClusters;
  set_groups(kBvhSearchGroups, goes_on ? sum.x : 0);
  set_groups(kBvhCountGroups, goes_on ? (sum.x + kBvhPairBlock - 1) / kBvhPairBlock : 0);
}
