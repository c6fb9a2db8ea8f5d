#ifndef LIGHTWELL_VOXEL_FACES_TESTING_FACE_LOOKUP_H
#define LIGHTWELL_VOXEL_FACES_TESTING_FACE_LOOKUP_H
#include "passes/voxel_faces/voxel_faces_types.h"

#define LW_SURFACE_POINT(MEMBER) MEMBER(vec4, position) MEMBER(vec4, normal)
LW_STRUCT(SurfacePoint, LW_SURFACE_POINT)

#define LW_FACE_LOOKUP_PARAMS(MEMBER) MEMBER(VoxelLevels, levels) MEMBER(uint, count)
LW_PUSH_CONSTANTS(FaceLookupParams, LW_FACE_LOOKUP_PARAMS)

#endif
