// Shadow maps: parameters of one view, shared with shadow.vert and shadow_masked.vert.
#ifndef LIGHTWELL_PASSES_SHADOW_H
#define LIGHTWELL_PASSES_SHADOW_H

#include "shaders/shared.h"

#define LW_SHADOW_PARAMS(MEMBER) MEMBER(uint, view) MEMBER(uint, face)
LW_PUSH_CONSTANTS(ShadowParams, LW_SHADOW_PARAMS)

#endif
