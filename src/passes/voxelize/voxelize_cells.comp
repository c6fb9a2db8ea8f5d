// Marks the cells that triangles meet, with the directions that their sides face (voxelize_types.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxelize/voxelize_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
LW_PAGED_READ(0, 2, VoxelTile, tiles)
layout(set = 0, binding = 3) readonly buffer TileCountBuffer { uint data[]; } tile_counts;
layout(set = 0, binding = 4) buffer CellBuffer { uint data[]; } cells;
layout(set = 0, binding = 5) readonly buffer GroupBuffer { uint data[]; } groups;

#include "passes/voxelize/triangle_cells.glsl"

void visit_cell(Triangle source, CellTriangle triangle, ivec3 cell) {
  uint word = kCellOccupied;
  if (triangle.normal != vec3(0.0)) {
    word |= 1u << normal_direction(triangle.normal);
    word |= 1u << (kCellBackShift + normal_direction(-triangle.normal));
  }
  uint index = grid_cell_index(params.grid, cell);
  // Most pairs add nothing: look before the atomic.
  if ((cells.data[index] & word) != word) atomicOr(cells.data[index], word);
}

#include "shaders/linear_dispatch.glsl"
#include "passes/voxelize/triangle_groups.glsl"
#define LW_VISITED_TRIANGLE triangle_of_group
#include "passes/voxelize/visit_triangles.glsl"

void main() {
  visit_triangles(params.grid, params.triangles);
}
