// One round of merging, first step: every cluster looks for its partner.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer StateBuffer { uint data[]; } state;
layout(set = 0, binding = 1) readonly buffer LowBuffer { uvec4 data[]; } lows;
layout(set = 0, binding = 2) readonly buffer HighBuffer { uvec4 data[]; } highs;
layout(set = 0, binding = 3) readonly buffer ClusterBuffer { uint data[]; } clusters;
layout(set = 0, binding = 4) writeonly buffer PartnerBuffer { uint data[]; } partners;

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_likeness.glsl"

void main() {
  uint i = linear_invocation();
  uint count = state.data[kBvhClusters];
  if (i >= count) return;
  partners.data[i] =
      params.forced != 0 ? paired_cluster(i, count) : nearest_cluster(i, count, state.data[kBvhHalf] * params.count);
}
