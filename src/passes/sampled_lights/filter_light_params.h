// Noise filter of sampled light: parameters shared with light_variance.comp and filter_light.comp.
#ifndef LIGHTWELL_SAMPLED_LIGHTS_FILTER_H
#define LIGHTWELL_SAMPLED_LIGHTS_FILTER_H

#include "shaders/shared.h"

#define LW_FILTER_LIGHT_PARAMS(MEMBER)                           \
  MEMBER(uvec2, size)                                            \
  MEMBER(float, pixel_tangent) /* side of a pixel 1 m away, m */ \
  MEMBER(int, step)            /* between taps, pixels */        \
  MEMBER(uint, diagonal)       /* 1: taps along the diagonals, not the axes */
LW_PUSH_CONSTANTS(FilterLightParams, LW_FILTER_LIGHT_PARAMS)

#endif
