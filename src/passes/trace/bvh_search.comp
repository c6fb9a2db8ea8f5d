// One round of merging, first step: every cluster looks for its partner.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer StateBuffer { uint data[]; } state;
LW_PAGED_READ(0, 1, uvec4, lows)
LW_PAGED_READ(0, 2, uvec4, highs)
LW_PAGED_READ(0, 3, uint, clusters)
LW_PAGED_WRITE(0, 4, uint, partners)

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_likeness.glsl"

void main() {
  uint i = linear_invocation();
  uint count = state.data[kBvhClusters];
  if (i >= count) return;
  partners_store(i, params.forced != 0 ? paired_cluster(i, count)
                                       : nearest_cluster(i, count, state.data[kBvhHalf] * params.count));
}
