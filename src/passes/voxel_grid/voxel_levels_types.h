// Nested grids about a point of interest, as host and shaders see them: what large scenes are kept in.
//
// Every level is a cube of resolution^3 cells. The coarsest covers the scene; each finer one has cells of half the side
// and lies about `focus`, snapped to kLevelSnap cells, inside the coarser ones. As the focus moves along an axis one
// level moves at a time: a level is snapped where its focus is nearest to, half of its snap from where finer levels
// are. Cells have integer coordinates from `origin`, in their level's own size, whatever the window over them; buffers
// hold one element a cell of every level, the coarsest level first, x fastest, at these coordinates modulo the
// resolution (toroidal): a cell that stays inside keeps its place when the window moves on.
#ifndef LIGHTWELL_VOXEL_LEVELS_TYPES_H
#define LIGHTWELL_VOXEL_LEVELS_TYPES_H

#include "passes/voxel_grid/voxel_grid_types.h"

#define LW_VOXEL_LEVELS(MEMBER)                                                           \
  MEMBER(vec3, origin)     /* world position of the lower corner of the coarsest level */ \
  MEMBER(float, cell_size) /* of the finest level, m */                                   \
  MEMBER(ivec3, center)    /* the finest cell that holds the focus */                     \
  MEMBER(uint, resolution) /* cells a side of every level */                              \
  MEMBER(vec3, focus)      /* m; inside the coarsest level */                             \
  MEMBER(uint, count)      /* levels; level 0 is the finest */
LW_STRUCT(VoxelLevels, LW_VOXEL_LEVELS)

LW_CONSTANT(int, kLevelSnap, 4)  // cells; a power of two

#ifndef __cplusplus

#include "shaders/software_drivers.glsl"

uint level_cell_count(VoxelLevels levels) {
  return levels.resolution * levels.resolution * levels.resolution;
}

float level_cell_size(VoxelLevels levels, uint level) {
  return levels.cell_size * float(1u << level);
}

// Coordinates of a level's lowest cell.
ivec3 level_lower(VoxelLevels levels, uint level) {
  int side = int(levels.resolution);
  ivec3 last = ivec3((side << (levels.count - 1 - level)) - side);
  return clamp(((levels.center >> level) - side / 2 + kLevelSnap / 2) & ~(kLevelSnap - 1), ivec3(0), last);
}

// The cells inside a level's window; theirs are numbers from its lower corner.
VoxelGrid level_grid(VoxelLevels levels, uint level) {
  float size = level_cell_size(levels, level);
  vec3 lower = levels.origin + vec3(level_lower(levels, level)) * size;
  return VoxelGrid(lower, size, uvec3(levels.resolution), level_cell_count(levels));
}

// Place in buffers of the cell with these coordinates, from the window's lower corner, inside it.
uint level_cell_index(VoxelLevels levels, uint level, ivec3 cell) {
  uvec3 place = uvec3(cell + level_lower(levels, level)) % levels.resolution;
  uint first = (levels.count - 1 - level) * level_cell_count(levels);
  return first + (place.z * levels.resolution + place.y) * levels.resolution + place.x;
}

uint level_of_index(VoxelLevels levels, uint index) {
  return levels.count - 1 - index / level_cell_count(levels);
}

// The cell at a place in buffers, from the lower corner of its level's window.
ivec3 level_cell_at(VoxelLevels levels, uint index) {
  uint rest = index % level_cell_count(levels);
  uint row = rest / levels.resolution;
  ivec3 place = ivec3(rest % levels.resolution, row % levels.resolution, row / levels.resolution);
  int side = int(levels.resolution);
  ivec3 lower = level_lower(levels, level_of_index(levels, index)) % side;
  return place - lower + mix(ivec3(0), ivec3(side), lessThan(place, lower));
}

// Whether the place in buffers held the same cell when the levels lay about `old_center`.
bool is_same_cell(VoxelLevels levels, ivec3 old_center, uint index) {
  uint level = level_of_index(levels, index);
  VoxelLevels old = levels;
  old.center = old_center;
  ivec3 moved = level_lower(levels, level) - level_lower(old, level);
  bool is_same = true;
  for (uint i = 0; i < LW_ROUNDS_IF(moved != ivec3(0), 1); ++i) {
    ivec3 old_cell = level_cell_at(levels, index) + moved;
    is_same = all(greaterThanEqual(old_cell, ivec3(0))) && all(lessThan(old_cell, ivec3(levels.resolution)));
  }
  return is_same;
}

// How far inside a level a position is: 1 up to where it fades into the next coarser one, 0 from where its window may
// end. The same for every window that the focus allows, so that nothing jumps when one moves on; 1 in the coarsest
// level.
float level_weight(VoxelLevels levels, uint level, vec3 position) {
  if (level + 1 >= levels.count) return 1.0;
  vec3 away = abs(position - levels.focus) / level_cell_size(levels, level);
  float end = 0.5 * float(levels.resolution) - 0.5 * float(kLevelSnap) - 1.0;
  float fade = max(float(levels.resolution) / 4.0, 1.0);
  return clamp((end - max(max(away.x, away.y), away.z)) / fade, 0.0, 1.0);
}

// The finest level that a position is wholly inside of and whose cells are no smaller than `footprint`, m.
uint level_at(VoxelLevels levels, vec3 position, float footprint) {
  uint level = 0;
  while (level + 1 < levels.count &&
         (level_weight(levels, level, position) <= 0.0 || level_cell_size(levels, level) < footprint))
    ++level;
  return level;
}

#endif

#endif
