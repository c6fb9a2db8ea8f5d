// Brings the cells of a box, as voxelised, to their places among the cells of all levels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxel_faces/voxel_faces_params.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(FaceCellsParams, LW_FACE_CELLS_PARAMS)
layout(set = 0, binding = 0) readonly buffer BoxBuffer { uint data[]; } box;
layout(set = 0, binding = 1) writeonly buffer CellBuffer { uint data[]; } cells;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint index = linear_invocation();
  uvec3 size = params.size;
  if (index >= size.x * size.y * size.z) return;
  ivec3 cell = params.lower + ivec3(index % size.x, index / size.x % size.y, index / (size.x * size.y));
  cells.data[level_cell_index(params.levels, params.level, cell)] = box.data[index];
}
