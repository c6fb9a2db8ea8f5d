// Buffers and parameters of conservative voxelisation, as host and kernels see them.
#ifndef LIGHTWELL_VOXELIZE_TYPES_H
#define LIGHTWELL_VOXELIZE_TYPES_H

#include "passes/voxel_grid/voxel_grid_types.h"

// A direction is one of six: 2 * axis, + 1 where the normal points down the axis. A cell's word says what is in it:
// bit d: a triangle's front has a normal whose largest component points in direction d; bit 6 + d: a back has;
// bit 12: any triangle at all, those without an area included.
LW_CONSTANT(uint, kCellBackShift, 6)
LW_CONSTANT(uint, kCellOccupied, 1 << 12)

// A triangle whose bounds hold more cells than this is cut into tiles of 4x4x4 cells.
LW_CONSTANT(uint, kSmallTriangleCells, 16)
LW_CONSTANT(int, kTileSide, 4)

// Triangles, of those that are chosen, whose common bounds are asked before each of them is.
LW_CONSTANT(uint, kTriangleGroup, 16)
// Words of a list of groups: arguments of an indirect dispatch, how many there are, then the groups.
LW_CONSTANT(uint, kGroupsListed, 3)
LW_CONSTANT(uint, kGroupHeader, 4)

// What one dispatch of a visiting kernel (visit_triangles.glsl) goes through.
LW_CONSTANT(uint, kVisitSmallTriangles, 0)  // one invocation a triangle
LW_CONSTANT(uint, kVisitTiles, 1)           // one workgroup of 64 a tile, one invocation a cell
LW_CONSTANT(uint, kVisitLargeTriangles, 2)  // one invocation a triangle: only where the list of tiles overflowed

// A large triangle meets the tile with these coordinates, 10 bits each, x lowest.
#define LW_VOXEL_TILE(MEMBER) MEMBER(uint, triangle) MEMBER(uint, tile)
LW_STRUCT(VoxelTile, LW_VOXEL_TILE)

// Words of the buffer `tile_counts`: arguments of two indirect dispatches, then the number of tiles found.
LW_CONSTANT(uint, kTileGroups, 0)   // 3 words: for kVisitTiles
LW_CONSTANT(uint, kLargeGroups, 3)  // 3 words: for kVisitLargeTriangles, 0 unless the list overflowed
LW_CONSTANT(uint, kTilesFound, 6)
LW_CONSTANT(uint, kTileCountWords, 8)

// All triangles of a scene but those of one gap: chosen number i is triangle i below `gap_first`, and i + gap_count
// from there on.
#define LW_TRIANGLE_CHOICE(MEMBER)          \
  MEMBER(uint, count) /* of those chosen */ \
  MEMBER(uint, gap_first)                   \
  MEMBER(uint, gap_count)
LW_STRUCT(TriangleChoice, LW_TRIANGLE_CHOICE)

#ifndef __cplusplus

uint chosen_triangle(TriangleChoice choice, uint i) {
  return i < choice.gap_first ? i : i + choice.gap_count;
}

#endif

#define LW_VOXELIZE_PARAMS(MEMBER)  \
  MEMBER(VoxelGrid, grid)           \
  MEMBER(TriangleChoice, triangles) \
  MEMBER(uint, tile_capacity)

#endif
