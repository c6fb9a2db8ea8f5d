// Reflective shadow maps: parameters of the sums over each light's tiles, shared with rsm_powers.comp.
#ifndef LIGHTWELL_PASSES_RSM_POWERS_H
#define LIGHTWELL_PASSES_RSM_POWERS_H

#include "shaders/shared.h"

#define LW_RSM_POWERS_PARAMS(MEMBER) MEMBER(uint, light_count) MEMBER(uint, top_level) /* where a tile is one texel */
LW_PUSH_CONSTANTS(RsmPowersParams, LW_RSM_POWERS_PARAMS)

#endif
