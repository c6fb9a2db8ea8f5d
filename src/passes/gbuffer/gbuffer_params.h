// G-buffer: parameters shared with gbuffer.vert.
#ifndef LIGHTWELL_PASSES_GBUFFER_PARAMS_H
#define LIGHTWELL_PASSES_GBUFFER_PARAMS_H

#include "shaders/shared.h"

// first_index: of the alpha-masked triangles.
#define LW_GBUFFER_PARAMS(MEMBER) MEMBER(uint, first_index)
LW_PUSH_CONSTANTS(GBufferParams, LW_GBUFFER_PARAMS)

#endif
