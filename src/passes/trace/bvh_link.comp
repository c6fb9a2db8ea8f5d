// Writes the wide nodes' references to their children. Boxes follow from the leaves up, as after every movement.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer SizeBuffer { uint data[]; } sizes;
layout(set = 0, binding = 1) readonly buffer MarkBuffer { uint data[]; } marks;
layout(set = 0, binding = 2) readonly buffer RankBuffer { uint data[]; } ranks;
layout(set = 0, binding = 3) readonly buffer BlockBuffer { uvec2 data[]; } blocks;
layout(set = 0, binding = 4) readonly buffer FirstBuffer { uint data[]; } firsts;
layout(set = 0, binding = 5) readonly buffer ChildBuffer { uvec4 data[]; } children;
layout(set = 0, binding = 6) writeonly buffer NodeBuffer { uvec4 data[]; } nodes;

#include "shaders/linear_dispatch.glsl"

uint marked_before(uint inner) { return blocks.data[inner / kBvhScanBlock].x + ranks.data[inner]; }

void main() {
  uint inner = linear_invocation();
  if (inner + 1 >= params.count || marks.data[inner] == 0) return;
  uint last = params.count - 2;
  uint total = marked_before(last) + marks.data[last];
  uvec4 references = uvec4(kBvhNothing);
  for (uint i = 0; i < 4; ++i) {
    uint child = children.data[inner][i];
    if (child == kBvhNothing) break;
    bool single = child < params.count;
    uint below = single ? 1 : sizes.data[child - params.count];
    if (below > kBvhLeafTriangles) {
      references[i] = params.node_first + total - 1 - marked_before(child - params.count);
    } else {
      references[i] = kBvhLeafFlag | (below - 1) << kBvhLeafCountShift | (params.slot_first + firsts.data[child]);
    }
  }
  nodes.data[kBvhNodeWords * (params.node_first + total - 1 - marked_before(inner)) + 3] = references;
}
