#ifndef LIGHTWELL_GRAPH_TESTING_SCALE_H
#define LIGHTWELL_GRAPH_TESTING_SCALE_H
#include "shaders/shared.h"
#define LW_SCALE_PARAMS(MEMBER) MEMBER(uint, count) MEMBER(uint, factor)
LW_PUSH_CONSTANTS(ScaleParams, LW_SCALE_PARAMS)
#endif
