// Reflective shadow maps: parameters of one view, shared with rsm.vert and rsm.frag.
#ifndef LIGHTWELL_PASSES_RSM_H
#define LIGHTWELL_PASSES_RSM_H

#include "shaders/shared.h"

#define LW_RSM_PARAMS(MEMBER) MEMBER(uint, light) MEMBER(uint, face)
LW_PUSH_CONSTANTS(RsmParams, LW_RSM_PARAMS)

#endif
