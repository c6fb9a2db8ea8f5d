// Light points sorted into cells, which merge where they hold few: what host and kernels share.
#ifndef LIGHTWELL_PHOTON_SPLATTING_STRATIFY_TYPES_H
#define LIGHTWELL_PHOTON_SPLATTING_STRATIFY_TYPES_H

#include "passes/voxel_grid/voxel_grid_types.h"
#include "shaders/shared.h"

// Cells are numbered along Morton's curve, with so many bits an axis at most: a block of 2^l x 2^l x 2^l of them, from
// a multiple of 2^l on, is one range of keys. Light points that are none come last.
LW_CONSTANT(uint, kStratifyAxisBits, 8)
LW_CONSTANT(uint, kMostMergeLevels, 8)

#define LW_STRATIFY_PARAMS(MEMBER)                                          \
  MEMBER(VoxelGrid, grid)                                                   \
  MEMBER(uint, point_count)                                                 \
  MEMBER(uint, no_cell)   /* key of light points that are none */           \
  MEMBER(uint, threshold) /* a block with a part of fewer photons merges */ \
  MEMBER(uint, levels)    /* of blocks */                                   \
  MEMBER(uint, capacity)  /* splats */                                      \
  MEMBER(uint, map_side)  /* texels */
LW_PUSH_CONSTANTS(StratifyParams, LW_STRATIFY_PARAMS)

#endif
