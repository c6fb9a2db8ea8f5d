// Environment behind everything: parameters shared with background.comp.
#ifndef LIGHTWELL_PASSES_BACKGROUND_H
#define LIGHTWELL_PASSES_BACKGROUND_H

#include "shaders/shared.h"

#define LW_BACKGROUND_PARAMS(MEMBER) MEMBER(uvec2, size)
LW_PUSH_CONSTANTS(BackgroundParams, LW_BACKGROUND_PARAMS)

#endif
