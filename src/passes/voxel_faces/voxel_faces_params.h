// Push constants of the kernels of this folder.
#ifndef LIGHTWELL_VOXEL_FACES_PARAMS_H
#define LIGHTWELL_VOXEL_FACES_PARAMS_H

#include "passes/voxel_faces/voxel_faces_types.h"

LW_PUSH_CONSTANTS(VoxelFaceParams, LW_VOXEL_FACE_PARAMS)

#endif
