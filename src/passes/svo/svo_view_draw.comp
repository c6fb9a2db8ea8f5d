// Arguments of the draw of all boxes: an instance a node.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_types.h"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) writeonly buffer DrawBuffer { uint data[]; } draw;

void main() {
  draw.data[0] = 36;  // vertices of a box
  draw.data[1] = counts.data[kSvoNodesUsed];
  draw.data[2] = 0;
  draw.data[3] = 0;
}
