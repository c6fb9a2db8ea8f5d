// Counts the faces of every block of cells.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxel_faces/voxel_faces_params.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kStanding = 0;
layout(set = 0, binding = 0) readonly buffer StandingBuffer { uint data[]; } standing;
layout(set = 0, binding = 1) readonly buffer CellBuffer { uint data[]; } cells;
layout(set = 0, binding = 2) writeonly buffer BlockBuffer { uint data[]; } block_faces;

#include "passes/voxel_faces/face_directions.glsl"
#include "shaders/linear_dispatch.glsl"

void main() {
  uint block = linear_invocation();
  uint first = block * kFaceBlock;
  if (first >= params.grid.cell_count) return;
  uint end = min(first + kFaceBlock, params.grid.cell_count);
  uint faces = 0;
  for (uint cell = first; cell < end; ++cell) faces += bitCount(face_directions(cell));
  block_faces.data[block] = faces;
}
