// Where the levels of the wide hierarchy begin: of the nodes that a round of merging made, those marked follow each other,
// in reverse. Also the root's reference.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer StateBuffer { uint data[]; } state;
layout(set = 0, binding = 1) readonly buffer MarkBuffer { uint data[]; } marks;
layout(set = 0, binding = 2) readonly buffer RankBuffer { uint data[]; } ranks;
layout(set = 0, binding = 3) readonly buffer BlockBuffer { uvec2 data[]; } blocks;
layout(set = 0, binding = 4) writeonly buffer LevelBuffer { uint data[]; } levels;
layout(set = 0, binding = 5) buffer NodeBuffer { uvec4 data[]; } nodes;

#include "shaders/linear_dispatch.glsl"

// Marked nodes before inner node `inner`.
uint marked_before(uint inner) {
  if (inner == 0) return 0;
  uint last = inner - 1;
  return blocks.data[last / kBvhScanBlock].x + ranks.data[last] + marks.data[last];
}

void main() {
  uint inner_nodes = params.count - 1;
  uint total = marked_before(inner_nodes);
  for (uint level = gl_LocalInvocationID.x; level <= params.rounds + kBvhTopRounds; level += 64) {
    uint range = kBvhRounds + 4 * level + 3;
    uint first = total - marked_before(state.data[range]);
    uint next = level < params.rounds + kBvhTopRounds ? total - marked_before(state.data[range + 4]) : first;
    uvec3 groups = linear_groups((first - next + 63) / 64);
    if (first == next) groups = uvec3(0);
    for (uint i = 0; i < 3; ++i) levels.data[4 * level + i] = groups[i];
    levels.data[4 * level + 3] = first;
  }
  if (gl_LocalInvocationID.x == 0)
    nodes.data[0][params.root_word] =
        total > 0 ? params.node_first : kBvhLeafFlag | (params.count - 1) << kBvhLeafCountShift | params.slot_first;
}
