// Making the table of emissive triangles: parameters shared with emitters_list.comp and emitters_sum.comp.
#ifndef LIGHTWELL_EMITTERS_PARAMS_H
#define LIGHTWELL_EMITTERS_PARAMS_H

#include "shaders/shared.h"

#define LW_EMITTER_PARAMS(MEMBER) MEMBER(uint, count)
LW_PUSH_CONSTANTS(EmitterParams, LW_EMITTER_PARAMS)

#endif
