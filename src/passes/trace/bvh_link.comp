// Writes the wide nodes' references to their children. Boxes follow from the leaves up, as after every movement.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sort/sort_types.h"
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
LW_PAGED_READ(0, 0, uint, sizes)
LW_PAGED_READ(0, 1, uint, marks)
LW_PAGED_READ(0, 2, uint, ranks)
layout(set = 0, binding = 3) readonly buffer BlockBuffer { uvec2 data[]; } blocks;
LW_PAGED_READ(0, 4, uint, firsts)
LW_PAGED_READ(0, 5, uvec4, children)
LW_PAGED_WRITE(0, 6, uvec4, nodes)

#include "shaders/linear_dispatch.glsl"

uint marked_before(uint inner) { return blocks.data[inner / kScanBlock].x + ranks_at(inner); }

void main() {
  uint inner = linear_invocation();
  if (inner + 1 >= params.count || marks_at(inner) == 0) return;
  uint last = params.count - 2;
  uint total = marked_before(last) + marks_at(last);
  uvec4 references = uvec4(kBvhNothing);
  for (uint i = 0; i < 4; ++i) {
    uint child = children_at(inner)[i];
    if (child == kBvhNothing) break;
    bool single = child < params.count;
    uint below = single ? 1 : sizes_at(child - params.count);
    if (below > kBvhLeafTriangles) {
      references[i] = params.node_first + total - 1 - marked_before(child - params.count);
    } else {
      references[i] = kBvhLeafFlag | (below - 1) << kBvhLeafCountShift | (params.slot_first + firsts_at(child));
    }
  }
  nodes_store(kBvhNodeWords * (params.node_first + total - 1 - marked_before(inner)) + 3, references);
}
