// Prefix sums, first half: before each element, the sum of those before it in its block; and each block's sum.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer InputBuffer { uint data[]; } elements;
layout(set = 0, binding = 1) writeonly buffer OutputBuffer { uint data[]; } sums;
layout(set = 0, binding = 2) writeonly buffer BlockBuffer { uvec2 data[]; } blocks;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint block = linear_invocation();
  uint first = block * kBvhScanBlock;
  if (first >= params.total) return;
  uint end = min(first + kBvhScanBlock, params.total);
  uint sum = 0;
  for (uint i = first; i < end; ++i) {
    uint element = elements.data[i];
    sums.data[i] = sum;
    sum += element;
  }
  blocks.data[block] = uvec2(sum, 0);
}
