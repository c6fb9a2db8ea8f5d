// Push constants of the kernels of this folder.
#ifndef LIGHTWELL_VOXELIZE_PARAMS_H
#define LIGHTWELL_VOXELIZE_PARAMS_H

#include "passes/voxelize/voxelize_types.h"

LW_PUSH_CONSTANTS(VoxelizeParams, LW_VOXELIZE_PARAMS)

#endif
