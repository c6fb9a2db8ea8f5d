// One round of merging, last step: partners become one cluster, the others stay.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer StateBuffer { uint data[]; } state;
layout(set = 0, binding = 1) readonly buffer PartnerBuffer { uint data[]; } partners;
layout(set = 0, binding = 2) readonly buffer BlockBuffer { uvec2 data[]; } blocks;
layout(set = 0, binding = 3) buffer LowBuffer { uvec4 data[]; } lows;
layout(set = 0, binding = 4) buffer HighBuffer { uvec4 data[]; } highs;
layout(set = 0, binding = 5) buffer SizeBuffer { uint data[]; } sizes;
layout(set = 0, binding = 6) buffer ClusterBuffer { uint data[]; } clusters;

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
    uint partner = partners.data[i];
    bool mutual = partner != i && partners.data[partner] == i;
    if (mutual && partner < i) continue;
    uint cluster = clusters.data[source + i];
    if (mutual) {
      make_inner_node(node, cluster, clusters.data[source + partner]);
      cluster = node++;
    }
    clusters.data[target++] = cluster;
  }
}
