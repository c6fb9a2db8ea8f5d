// One round of merging, last step: partners become one cluster, the others stay.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer StateBuffer { uint data[]; } state;
LW_PAGED_READ(0, 1, uint, partners)
layout(set = 0, binding = 2) readonly buffer BlockBuffer { uvec2 data[]; } blocks;
LW_PAGED_READ_WRITE(restrict, 0, 3, uvec4, lows)
LW_PAGED_READ_WRITE(restrict, 0, 4, uvec4, highs)
LW_PAGED_READ_WRITE(restrict, 0, 5, uint, sizes)
LW_PAGED_READ_WRITE(restrict, 0, 6, uint, clusters)

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_merge.glsl"

void main() {
  uint block = linear_invocation();
  uint count = state.data[kBvhOldClusters];
  uint first = block * kBvhPairBlock;
  if (first >= count) return;
  uint end = min(first + kBvhPairBlock, count);
  uint source = state.data[kBvhOldHalf] * params.count;
  uvec2 place = blocks.data[block];
  uint target = (1 - state.data[kBvhOldHalf]) * params.count + place.x;
  uint node = params.count + state.data[kBvhOldInnerNodes] + place.y;
  for (uint i = first; i < end; ++i) {
    uint partner = partners_at(i);
    bool mutual = partner != i && partners_at(partner) == i;
    if (mutual && partner < i) continue;
    uint cluster = clusters_at(source + i);
    if (mutual) {
      make_inner_node(node, cluster, clusters_at(source + partner));
      cluster = node++;
    }
    clusters_store(target++, cluster);
  }
}
