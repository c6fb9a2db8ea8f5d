// The grid of cubic cells that every voxel technique stores its light in, as host and shaders see it.
//
// Cell (0, 0, 0) has its lower corner at `origin`; cell centres lie at origin + (c + 0.5) * cell_size. Buffers hold one
// element a cell, x fastest.
#ifndef LIGHTWELL_VOXEL_GRID_TYPES_H
#define LIGHTWELL_VOXEL_GRID_TYPES_H

#include "shaders/shared.h"

#define LW_VOXEL_GRID(MEMBER)                                        \
  MEMBER(vec3, origin)      /* world position of the lower corner */ \
  MEMBER(float, cell_size)  /* metres; cells are cubes */            \
  MEMBER(uvec3, resolution) /* cells along each axis */              \
  MEMBER(uint, cell_count)
LW_STRUCT(VoxelGrid, LW_VOXEL_GRID)

#ifndef __cplusplus

// In cells, not rounded: floor() of it is the cell that holds `position`.
vec3 grid_coordinates(VoxelGrid grid, vec3 position) {
  return (position - grid.origin) / grid.cell_size;
}

bool grid_contains(VoxelGrid grid, ivec3 cell) {
  return all(greaterThanEqual(cell, ivec3(0))) && all(lessThan(cell, ivec3(grid.resolution)));
}

// Of a cell inside the grid.
uint grid_cell_index(VoxelGrid grid, ivec3 cell) {
  return (uint(cell.z) * grid.resolution.y + uint(cell.y)) * grid.resolution.x + uint(cell.x);
}

vec3 grid_cell_center(VoxelGrid grid, ivec3 cell) {
  return grid.origin + (vec3(cell) + 0.5) * grid.cell_size;
}

#endif

#endif
