#ifndef LIGHTWELL_SVO_TESTING_RAYS_H
#define LIGHTWELL_SVO_TESTING_RAYS_H
#include "shaders/shared.h"

// Shadow rays between points on surfaces, world space; normals: unit.
#define LW_SVO_RAY(MEMBER) MEMBER(vec4, from) MEMBER(vec4, from_normal) MEMBER(vec4, to) MEMBER(vec4, to_normal)
LW_STRUCT(SvoRay, LW_SVO_RAY)

#define LW_SVO_RAY_PARAMS(MEMBER) MEMBER(uint, count)
LW_PUSH_CONSTANTS(SvoRayParams, LW_SVO_RAY_PARAMS)

LW_CONSTANT(uint, kSvoRestart, 0)
LW_CONSTANT(uint, kVoxels, 1)
LW_CONSTANT(uint, kVoxelsBetween, 2)

#endif
