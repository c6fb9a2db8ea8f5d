// Of last frame's faces whose cells have left their level's window, finds the coarser ones that hold their cells now. One
// invocation a cell that took the place of another.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxel_faces/voxel_faces_params.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(FacesLeftParams, LW_FACES_LEFT_PARAMS)
layout(set = 0, binding = 0) readonly buffer OldTableBuffer { uint data[]; } old_table;
layout(set = 0, binding = 1) readonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 2) writeonly buffer AfterBuffer { uint data[]; } after;

#include "shaders/linear_dispatch.glsl"

// Slot of the coarser face that holds this cell of the level; `cell`: from VoxelLevels::origin.
uint coarser_slot(ivec3 cell, uint direction) {
  for (uint level = params.level + 1; level < params.levels.count; ++level) {
    cell >>= 1;
    ivec3 inside = cell - level_lower(params.levels, level);
    if (any(lessThan(inside, ivec3(0))) || any(greaterThanEqual(inside, ivec3(params.levels.resolution)))) continue;
    uint slot = face_slot(table.data[level_cell_index(params.levels, level, inside)], direction);
    if (slot != kNoFace) return slot;
  }
  return kNoFace;
}

void main() {
  uint number = linear_invocation();
  if (number >= params.size.x * params.size.y * params.size.z) return;
  uint row = number / params.size.x;
  ivec3 cell = params.lower + ivec3(number % params.size.x, row % params.size.y, row / params.size.y);
  uint index = level_cell_index(params.levels, params.level, cell);
  VoxelLevels old = params.levels;
  old.center = params.old_center;
  ivec3 old_cell = level_cell_at(old, index) + level_lower(old, params.level);
  uint word = old_table.data[index];
  for (uint left = word & kFaceDirections; left != 0; left &= left - 1u) {
    uint direction = uint(findLSB(left));
    after.data[face_slot(word, direction)] = coarser_slot(old_cell, direction);
  }
}
