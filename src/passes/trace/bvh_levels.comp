// Where the levels of the wide hierarchy begin: of the nodes that a round of merging made, those marked follow each other,
// in reverse. Also the root's reference.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sort/sort_types.h"
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer StateBuffer { uint data[]; } state;
LW_PAGED_READ(0, 1, uint, marks)
LW_PAGED_READ(0, 2, uint, ranks)
layout(set = 0, binding = 3) readonly buffer BlockBuffer { uvec2 data[]; } blocks;
layout(set = 0, binding = 4) writeonly buffer LevelBuffer { uint data[]; } levels;
LW_PAGED_READ_WRITE(restrict, 0, 5, uvec4, nodes)

#include "shaders/linear_dispatch.glsl"

// Marked nodes before inner node `inner`.
uint marked_before(uint inner) {
  if (inner == 0) return 0;
  uint last = inner - 1;
  return blocks.data[last / kScanBlock].x + ranks_at(last) + marks_at(last);
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
  if (gl_LocalInvocationID.x == 0) {
    uvec4 roots = nodes_at(0);
    roots[params.root_word] =
        total > 0 ? params.node_first : kBvhLeafFlag | (params.count - 1) << kBvhLeafCountShift | params.slot_first;
    nodes_store(0, roots);
  }
}
