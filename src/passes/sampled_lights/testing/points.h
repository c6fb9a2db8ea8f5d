// Points of random.glsl: parameters shared with points.comp.
#ifndef LIGHTWELL_SAMPLED_LIGHTS_TESTING_POINTS_H
#define LIGHTWELL_SAMPLED_LIGHTS_TESTING_POINTS_H

#include "shaders/shared.h"

#define LW_POINTS_PARAMS(MEMBER) MEMBER(uvec2, size) MEMBER(uint, count) MEMBER(uint, set)
LW_PUSH_CONSTANTS(PointsParams, LW_POINTS_PARAMS)

#endif
