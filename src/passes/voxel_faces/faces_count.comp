// Counts the faces of every block of cells.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxel_faces/voxel_faces_params.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMoving = 0;
LW_PUSH_CONSTANTS(VoxelFaceParams, LW_VOXEL_FACE_PARAMS)
layout(set = 0, binding = 0) readonly buffer StandingBuffer { uint data[]; } standing;
layout(set = 0, binding = 1) readonly buffer MovingBuffer { uint data[]; } moving;
layout(set = 0, binding = 2) writeonly buffer BlockBuffer { uint data[]; } block_faces;

#include "passes/voxel_faces/face_directions.glsl"
#include "shaders/linear_dispatch.glsl"

void main() {
  uint cell_count = params.levels.count * level_cell_count(params.levels);
  uint block = linear_invocation();
  uint first = block * kFaceBlock;
  if (first >= cell_count) return;
  uint end = min(first + kFaceBlock, cell_count);
  uint faces = 0;
  for (uint cell = first; cell < end; ++cell) faces += bitCount(face_directions(cell));
  block_faces.data[block] = faces;
}
