// From irradiance to radiance: parameters shared with combine.comp and film.comp.
#ifndef LIGHTWELL_PASSES_COMBINE_H
#define LIGHTWELL_PASSES_COMBINE_H

#include "shaders/shared.h"

// has_*: whether the image bound there counts. first_sample: the film starts afresh.
#define LW_COMBINE_PARAMS(MEMBER) \
  MEMBER(uvec2, size)             \
  MEMBER(uint, has_direct)        \
  MEMBER(uint, has_indirect)      \
  MEMBER(uint, has_specular)      \
  MEMBER(uint, first_sample)
LW_PUSH_CONSTANTS(CombineParams, LW_COMBINE_PARAMS)

#endif
