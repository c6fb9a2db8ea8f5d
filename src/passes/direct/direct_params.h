// Deferred direct light: parameters shared with direct.comp.
#ifndef LIGHTWELL_PASSES_DIRECT_H
#define LIGHTWELL_PASSES_DIRECT_H

#include "shaders/shared.h"

#define LW_DIRECT_PARAMS(MEMBER) MEMBER(uvec2, size) MEMBER(uint, light_count)
LW_PUSH_CONSTANTS(DirectParams, LW_DIRECT_PARAMS)

#endif
