// Prefix sums, first half: before each element, the sum of those before it in its block; and each block's sum.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sort/sort_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
LW_PAGED_READ(0, 0, uint, elements)
LW_PAGED_WRITE(0, 1, uint, sums)
layout(set = 0, binding = 2) writeonly buffer BlockBuffer { uvec2 data[]; } blocks;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint block = linear_invocation();
  uint first = block * kScanBlock;
  if (first >= params.count) return;
  uint end = min(first + kScanBlock, params.count);
  uint sum = 0;
  for (uint i = first; i < end; ++i) {
    uint element = elements_at(i);
    sums_store(i, sum);
    sum += element;
  }
  blocks.data[block] = uvec2(sum, 0);
}
