// Push constants of the kernels that build the octree. A kernel declares its own with LW_PUSH_CONSTANTS.
#ifndef LIGHTWELL_SVO_PARAMS_H
#define LIGHTWELL_SVO_PARAMS_H

#include "passes/svo/svo_types.h"

#define LW_SVO_BUILD_PARAMS(MEMBER)                                   \
  MEMBER(VoxelGrid, grid)   /* of the level that is voxelised */      \
  MEMBER(uint, voxel_level) /* which one */                           \
  MEMBER(uint, level_count)                                           \
  MEMBER(uint, triangle_count)                                        \
  MEMBER(uint, level)         /* log2 of a level's cells a side */    \
  MEMBER(uint, depth)         /* of the nodes that a pass works on */ \
  MEMBER(uint, list_capacity) /* cells */                             \
  MEMBER(uint, node_tiles)    /* that the pool holds */               \
  MEMBER(uint, records)       /* 1: occupied leaves get one each */

#define LW_SVO_COARSE_PARAMS(MEMBER)                                                  \
  MEMBER(uint, side_log2)    /* of the bricks along a side that one level looks at */ \
  MEMBER(uint, source_first) /* where their words begin */                            \
  MEMBER(uint, target_first)

#ifdef __cplusplus
LW_PUSH_CONSTANTS(SvoBuildParams, LW_SVO_BUILD_PARAMS)
LW_PUSH_CONSTANTS(SvoCoarseParams, LW_SVO_COARSE_PARAMS)
#endif

#endif
