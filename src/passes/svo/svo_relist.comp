// After an overflow of the list: counts the occupied cells that are two and four times as large, then lists those of
// the finest size that fits. Eight times as large they always do. Of each level only those where no finer one lies.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_params.h"

LW_PUSH_CONSTANTS(SvoBuildParams, LW_SVO_BUILD_PARAMS)

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kWrite = 0;  // 0: counts; 1: lists
layout(set = 0, binding = 0) readonly buffer BitBuffer { uint data[]; } bits;
layout(set = 0, binding = 1) writeonly buffer ListBuffer { uint data[]; } list;
layout(set = 0, binding = 2) buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 3) readonly buffer WindowBuffer { ivec4 data[]; } windows;

#include "passes/svo/svo_cells.glsl"
#include "passes/svo/svo_windows.glsl"
#include "shaders/linear_dispatch.glsl"

void append(uint level, uvec3 cell) {
  uint slot = atomicAdd(counts.data[kSvoListCount], 1);
  if (slot < params.list_capacity) list.data[slot] = pack_entry(level, cell);
}

bool is_occupied(uint level, uvec3 brick) {
  uint word = first_word(level) + brick_words(brick, params.level - 2);
  return (bits.data[word] | bits.data[word + 1]) != 0;
}

void main() {
  uint index = linear_invocation();
  uint bricks_log2 = params.level - 2;
  uint level = index >> (3 * bricks_log2);
  if (level >= params.level_count) return;
  uint side_mask = (1u << bricks_log2) - 1u;
  uvec3 brick = uvec3(index, index >> bricks_log2, index >> (2 * bricks_log2)) & side_mask;
  uint octants = octants_of_brick(bits.data[2 * index], bits.data[2 * index + 1]);
  for (uint i = 0; i < 8 * kSeveralLevels; ++i)
    if (in_finer_window(level, 2 * brick + (uvec3(i, i >> 1, i >> 2) & 1u), 1)) octants &= ~(1u << i);
  if (kWrite == 0) {
    if (octants == 0) return;
    atomicAdd(counts.data[kSvoHalfCells], bitCount(octants));
    atomicAdd(counts.data[kSvoQuarterCells], 1);
    return;
  }
  bool half_fits = counts.data[kSvoHalfCells] <= params.list_capacity;
  bool quarter_fits = counts.data[kSvoQuarterCells] <= params.list_capacity;
  if (index == 0) counts.data[kSvoListLevel] = params.level - (half_fits ? 1 : quarter_fits ? 2 : 3);
  if (half_fits) {
    for (uint i = 0; i < 8; ++i)
      if ((octants & (1u << i)) != 0) append(level, 2 * brick + (uvec3(i, i >> 1, i >> 2) & 1u));
  } else if (quarter_fits) {
    if (octants != 0) append(level, brick);
  } else if (octant(brick) == 0 && !in_finer_window(level, brick >> 1, 3)) {
    bool any_occupied = false;
    for (uint i = 0; i < 8; ++i)
      any_occupied = any_occupied || is_occupied(level, brick + (uvec3(i, i >> 1, i >> 2) & 1u));
    if (any_occupied) append(level, brick >> 1);
  }
}
