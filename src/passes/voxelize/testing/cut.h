#ifndef LIGHTWELL_VOXELIZE_TESTING_CUT_H
#define LIGHTWELL_VOXELIZE_TESTING_CUT_H
#include "shaders/shared.h"

#define LW_CUT_CASE(MEMBER) MEMBER(vec4, a) MEMBER(vec4, b) MEMBER(vec4, c) MEMBER(vec4, normal)
LW_STRUCT(CutCase, LW_CUT_CASE)

#define LW_CUT_RESULT(MEMBER) MEMBER(vec4, center_area) MEMBER(vec4, low) MEMBER(vec4, high)
LW_STRUCT(CutResult, LW_CUT_RESULT)

#define LW_CUT_PARAMS(MEMBER) MEMBER(uint, count)
LW_PUSH_CONSTANTS(CutParams, LW_CUT_PARAMS)
#endif
