// Where a world position lies in the published grids, and what is there.
#ifndef LIGHTWELL_RAY_TRACED_VOXELS_PAPER_VOXELS_GLSL
#define LIGHTWELL_RAY_TRACED_VOXELS_PAPER_VOXELS_GLSL

#include "techniques/ray_traced_voxels/paper_types.h"

// Listings 7.6 and 7.7 write to int3(position - 1), position in voxels from the lower corner: all voxels lie one too
// low along each axis, and the two lowest layers share one. The final pass reads at the position itself. This is why
// voxels seem to be missing (section 5.1.3), and what the seven taps of listing 4.8 are to hide.
const float kPublishedOffset = 1.0;

// In voxels as they are stored; the voxel at `place` is stored_voxel(place).
vec3 stored_place(VoxelGrid grid, vec3 position) { return grid_coordinates(grid, position) - kPublishedOffset; }
ivec3 stored_voxel(vec3 place) { return ivec3(place); }  // rounds towards 0

// kNoVoxel outside the grid.
uint voxel_of(VoxelGrid grid, vec3 position) {
  vec3 place = stored_place(grid, position);
  bool inside = all(greaterThanEqual(place, vec3(-kPublishedOffset))) && all(lessThan(place, vec3(grid.resolution)));
  return inside ? grid_cell_index(grid, stored_voxel(place)) : kNoVoxel;
}

vec3 encode_normal(vec3 normal) { return normal * 0.5 + 0.5; }

// Shorter than 1 where normals of several directions were averaged; as published it stays so.
vec3 decode_normal(uint word) { return unpackUnorm4x8(word).rgb * 2.0 - 1.0; }

bool is_occupied(uint word) { return (word >> 24) != 0; }

#endif
