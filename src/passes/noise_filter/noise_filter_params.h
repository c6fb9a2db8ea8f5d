// Noise filter: parameters shared with variance.comp and noise_filter.comp.
#ifndef LIGHTWELL_NOISE_FILTER_PARAMS_H
#define LIGHTWELL_NOISE_FILTER_PARAMS_H

#include "shaders/shared.h"

#define LW_NOISE_FILTER_PARAMS(MEMBER)                           \
  MEMBER(uvec2, size)                                            \
  MEMBER(float, pixel_tangent) /* side of a pixel 1 m away, m */ \
  MEMBER(int, step)            /* between taps, pixels */        \
  MEMBER(uint, diagonal)       /* 1: taps along the diagonals, not the axes */
LW_PUSH_CONSTANTS(NoiseFilterParams, LW_NOISE_FILTER_PARAMS)

#endif
