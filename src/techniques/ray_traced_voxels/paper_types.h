// Parameters and buffers of the published ray-traced voxels, as host and kernels see them.
//
// A grid is one word a voxel: RGBA8, red in the lowest byte, alpha the number of samples (Magalhaes 2020, listing 4.1).
// With the exact writer irradiance is three floats a voxel instead, W/m^2.
#ifndef LIGHTWELL_RAY_TRACED_VOXELS_PAPER_TYPES_H
#define LIGHTWELL_RAY_TRACED_VOXELS_PAPER_TYPES_H

#include "passes/voxel_grid/voxel_grid_types.h"

// Who writes into a voxel that others write into as well (voxel_write.glsl).
LW_CONSTANT(uint, kWriteAverage, 0)  // moving average by compare and swap
LW_CONSTANT(uint, kWriteMaximum, 1)  // the larger packed word
LW_CONSTANT(uint, kWriteNone, 2)     // whoever comes last
LW_CONSTANT(uint, kWriteExact, 3)    // sums and a count (voxel_write_exact.glsl)

LW_CONSTANT(uint, kNoVoxel, 0xffffffffu)

LW_CONSTANT(uint, kExactHighWords, 3)        // of a voxel's sums, beside 4 low ones
LW_CONSTANT(uint, kExactIrradianceWords, 3)  // of a voxel of the grid that the exact writer leaves
LW_CONSTANT(uint, kRayBlock, 8)              // rays lie in the buffers by squares of so many a side, in Morton's order
LW_CONSTANT(uint, kExactRun, 16)             // hits that one invocation of the exact writer goes through
LW_CONSTANT(uint, kMostSecondaries, 8)

// Words of the buffer `touched_count`: how many voxels the exact writer has touched, and groups that go through them.
LW_CONSTANT(uint, kTouchedCount, 0)
LW_CONSTANT(uint, kTouchedGroups, 1)  // 3 words
LW_CONSTANT(uint, kTouchedWords, 4)

// What a ray writes where it hit.
#define LW_VOXEL_HIT(MEMBER)           \
  MEMBER(vec3, irradiance) /* W/m^2 */ \
  MEMBER(uint, voxel)      /* or kNoVoxel */
LW_STRUCT(VoxelHit, LW_VOXEL_HIT)

// Where a ray hit, for the one that is mirrored there.
#define LW_VOXEL_RAY(MEMBER)      \
  MEMBER(vec4, position)  /* m */ \
  MEMBER(vec4, direction) /* unit, with which it came */
LW_STRUCT(VoxelRay, LW_VOXEL_RAY)

#define LW_VOXEL_DRAW_PARAMS(MEMBER) MEMBER(VoxelGrid, grid)
#define LW_VOXEL_INJECT_PARAMS(MEMBER)                                             \
  MEMBER(VoxelGrid, grid)                                                          \
  MEMBER(vec3, low)  /* of the scene's bounds, m */                                \
  MEMBER(uint, side) /* side * side rays */                                        \
  MEMBER(vec3, high)                                                               \
  MEMBER(uint, light) /* from which they come; from the camera: how many lights */ \
  MEMBER(uint, secondaries)                                                        \
  MEMBER(float, least_distance) /* in front of a mirrored ray's start, m */
#define LW_VOXEL_WRITE_PARAMS(MEMBER)                   \
  MEMBER(uint, hit_count) /* a multiple of kExactRun */ \
  MEMBER(float, range)    /* W/m^2 that 255 stands for */
#define LW_VOXEL_ADD_PARAMS(MEMBER) \
  MEMBER(uint, cell_count)          \
  MEMBER(float, range)
#define LW_VOXEL_FINAL_PARAMS(MEMBER)                   \
  MEMBER(VoxelGrid, grid)                               \
  MEMBER(uvec2, size) /* pixels; x: number of points */ \
  MEMBER(float, range)                                  \
  MEMBER(float, ambient) /* W/m^2 */
#define LW_VOXEL_VIEW_PARAMS(MEMBER) \
  MEMBER(VoxelGrid, grid)            \
  MEMBER(uvec2, size)                \
  MEMBER(float, scale) /* of what is shown */

#ifdef __cplusplus
LW_PUSH_CONSTANTS(VoxelDrawParams, LW_VOXEL_DRAW_PARAMS)
LW_PUSH_CONSTANTS(VoxelInjectParams, LW_VOXEL_INJECT_PARAMS)
LW_PUSH_CONSTANTS(VoxelWriteParams, LW_VOXEL_WRITE_PARAMS)
LW_PUSH_CONSTANTS(VoxelAddParams, LW_VOXEL_ADD_PARAMS)
LW_PUSH_CONSTANTS(VoxelFinalParams, LW_VOXEL_FINAL_PARAMS)
LW_PUSH_CONSTANTS(VoxelViewParams, LW_VOXEL_VIEW_PARAMS)
#endif

#endif
