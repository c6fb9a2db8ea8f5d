// What level_functions.comp is asked, and answers.
#ifndef LIGHTWELL_VOXEL_GRID_TESTING_LEVEL_FUNCTIONS_H
#define LIGHTWELL_VOXEL_GRID_TESTING_LEVEL_FUNCTIONS_H

#include "passes/voxel_grid/voxel_levels_types.h"

#define LW_LEVEL_QUESTION(MEMBER)     \
  MEMBER(VoxelLevels, levels)         \
  MEMBER(ivec3, old_center)           \
  MEMBER(uint, index) /* of a cell */ \
  MEMBER(vec3, position)              \
  MEMBER(float, footprint)
LW_STRUCT(LevelQuestion, LW_LEVEL_QUESTION)

#define LW_LEVEL_ANSWER(MEMBER)                  \
  MEMBER(ivec3, lower) /* of the cell's level */ \
  MEMBER(uint, level)                            \
  MEMBER(vec3, origin) /* of its grid */         \
  MEMBER(float, cell_size)                       \
  MEMBER(ivec3, cell)                            \
  MEMBER(uint, index)   /* of `cell` */          \
  MEMBER(float, weight) /* of the position */    \
  MEMBER(uint, is_same)                          \
  MEMBER(uint, level_at) /* of the position */   \
  MEMBER(uint, unused)
LW_STRUCT(LevelAnswer, LW_LEVEL_ANSWER)

#define LW_LEVEL_FUNCTIONS_PARAMS(MEMBER) MEMBER(uint, count)
LW_PUSH_CONSTANTS(LevelFunctionsParams, LW_LEVEL_FUNCTIONS_PARAMS)

#endif
