// Shadow maps: parameters of one view, shared with shadow.vert and shadow_holes.vert.
// first_index: of the triangles with holes.
#ifndef LIGHTWELL_PASSES_SHADOW_H
#define LIGHTWELL_PASSES_SHADOW_H

#include "shaders/shared.h"

#define LW_SHADOW_PARAMS(MEMBER) MEMBER(uint, light) MEMBER(uint, face) MEMBER(uint, first_index)
LW_PUSH_CONSTANTS(ShadowParams, LW_SHADOW_PARAMS)

#endif
