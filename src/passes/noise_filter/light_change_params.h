// Change of light: parameters shared with change_filter.comp.
#ifndef LIGHTWELL_LIGHT_CHANGE_PARAMS_H
#define LIGHTWELL_LIGHT_CHANGE_PARAMS_H

#include "passes/noise_filter/light_change_types.h"

#define LW_LIGHT_CHANGE_PARAMS(MEMBER)                   \
  MEMBER(uvec2, block_count) /* blocks of the picture */ \
  MEMBER(int, step)          /* between taps, blocks */
LW_PUSH_CONSTANTS(LightChangeParams, LW_LIGHT_CHANGE_PARAMS)

#endif
