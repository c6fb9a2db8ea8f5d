// Marks an occupied cell and puts it on the list the first time. The including kernel declares `params`, `bits`,
// `list`, `counts` and `windows`.
#ifndef LIGHTWELL_SVO_ADD_CELL_GLSL
#define LIGHTWELL_SVO_ADD_CELL_GLSL

#include "passes/svo/svo_cells.glsl"
#include "passes/svo/svo_windows.glsl"

void add_cell(uvec3 cell) {
  uint bit = brick_bit(cell);
  uint word = first_word(params.voxel_level) + brick_words(cell >> 2, params.level - 2) + (bit >> 5);
  uint mask = 1u << (bit & 31u);
  // Most triangles add nothing to a cell: look before the atomic.
  if ((bits.data[word] & mask) != 0) return;
  if ((atomicOr(bits.data[word], mask) & mask) != 0) return;
  if (in_finer_window(params.voxel_level, cell, 0)) return;
  uint slot = atomicAdd(counts.data[kSvoFragments], 1);
  if (slot < params.list_capacity) list.data[slot] = pack_entry(params.voxel_level, cell);
}

#endif
