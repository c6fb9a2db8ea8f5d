// Push constants of the kernels of this folder.
#ifndef LIGHTWELL_VOXEL_FACES_PARAMS_H
#define LIGHTWELL_VOXEL_FACES_PARAMS_H

#include "passes/voxel_faces/voxel_faces_types.h"

#ifdef __cplusplus
LW_PUSH_CONSTANTS(VoxelFaceParams, LW_VOXEL_FACE_PARAMS)
LW_PUSH_CONSTANTS(FaceCellsParams, LW_FACE_CELLS_PARAMS)
LW_PUSH_CONSTANTS(FaceBeforeParams, LW_FACE_BEFORE_PARAMS)
#endif

#endif
