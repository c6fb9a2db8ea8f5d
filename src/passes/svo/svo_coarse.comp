// A coarser level of the bit grid: a bit for each brick that holds one. An invocation makes a brick of them, reading
// 4x4x4.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_params.h"

LW_PUSH_CONSTANTS(SvoCoarseParams, LW_SVO_COARSE_PARAMS)

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kFromBits = 0;  // 1: the bricks of the cells; 0: a level of `coarse`
layout(set = 0, binding = 0) readonly buffer BitBuffer { uint data[]; } bits;
layout(set = 0, binding = 1) buffer CoarseBuffer { uint data[]; } coarse;

#include "passes/svo/svo_cells.glsl"
#include "shaders/linear_dispatch.glsl"

uint word_of(uint index) {
  index += params.source_first;
  return kFromBits != 0 ? bits.data[index] : coarse.data[index];
}

void main() {
  uint index = linear_invocation();
  uint target_log2 = max(params.side_log2, 2) - 2;
  if (index >= 1u << (3 * target_log2)) return;
  uint side_mask = (1u << target_log2) - 1u;
  uvec3 target = uvec3(index, index >> target_log2, index >> (2 * target_log2)) & side_mask;
  uvec2 words = uvec2(0);
  // Where less than 4 bricks make a side, the others do not exist.
  uint side = 1u << min(params.side_log2, 2);
  for (uint z = 0; z < side; ++z) {
    for (uint y = 0; y < side; ++y) {
      for (uint x = 0; x < side; ++x) {
        uint source = brick_words(4 * target + uvec3(x, y, z), params.side_log2);
        bool occupied = (word_of(source) | word_of(source + 1)) != 0;
        uint bit = brick_bit(uvec3(x, y, z));
        if (occupied && bit < 32) words.x |= 1u << bit;
        if (occupied && bit >= 32) words.y |= 1u << (bit & 31u);
      }
    }
  }
  coarse.data[params.target_first + 2 * index] = words.x;
  coarse.data[params.target_first + 2 * index + 1] = words.y;
}
