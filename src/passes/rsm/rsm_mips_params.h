// Reflective shadow maps: parameters of one level of the luminance, shared with rsm_mips.comp.
#ifndef LIGHTWELL_PASSES_RSM_MIPS_H
#define LIGHTWELL_PASSES_RSM_MIPS_H

#include "shaders/shared.h"

#define LW_RSM_MIPS_PARAMS(MEMBER) MEMBER(uvec2, size) /* of the level that is written, texels */
LW_PUSH_CONSTANTS(RsmMipsParams, LW_RSM_MIPS_PARAMS)

#endif
