// Finds the slot that every face of last frame has now. Where its cell has left its level's window, that of the coarser
// face that holds it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxel_faces/voxel_faces_params.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(FaceBeforeParams, LW_FACE_BEFORE_PARAMS)
layout(set = 0, binding = 0) readonly buffer OldTableBuffer { uint data[]; } old_table;
layout(set = 0, binding = 1) readonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 2) writeonly buffer AfterBuffer { uint data[]; } after;

#include "shaders/linear_dispatch.glsl"

// The word of the next coarser cell that holds a cell which was at this place, and has a face in this direction; or 0.
uint coarser_word(uint index, uint direction) {
  uint level = level_of_index(params.levels, index);
  VoxelLevels old = params.levels;
  old.center = params.old_center;
  ivec3 cell = level_cell_at(old, index) + level_lower(old, level);
  while (++level < params.levels.count) {
    cell >>= 1;
    ivec3 inside = cell - level_lower(params.levels, level);
    if (any(lessThan(inside, ivec3(0))) || any(greaterThanEqual(inside, ivec3(params.levels.resolution)))) continue;
    uint word = table.data[level_cell_index(params.levels, level, inside)];
    if ((word & 1u << direction) != 0) return word;
  }
  return 0;
}

void main() {
  uint index = linear_invocation();
  if (index >= params.levels.count * level_cell_count(params.levels)) return;
  uint word = old_table.data[index];
  bool stays = is_same_cell(params.levels, params.old_center, index);
  for (uint left = word & kFaceDirections; left != 0; left &= left - 1u) {
    uint direction = uint(findLSB(left));
    uint now = stays ? table.data[index] : coarser_word(index, direction);
    after.data[face_slot(word, direction)] = face_slot(now, direction);
  }
}
