// Mean over frames: parameters shared with temporal_mean.comp.
#ifndef LIGHTWELL_TEMPORAL_MEAN_PARAMS_H
#define LIGHTWELL_TEMPORAL_MEAN_PARAMS_H

#include "shaders/shared.h"

#define LW_TEMPORAL_MEAN_PARAMS(MEMBER)                                                      \
  MEMBER(uvec2, size)                                                                        \
  MEMBER(uint, has_history)   /* 0: the mean starts with this frame */                       \
  MEMBER(float, most_frames)  /* that the history counts for */                              \
  MEMBER(float, blend_factor) /* weight of frame n: blend_factor / (n - 1 + blend_factor) */ \
  MEMBER(uint, limit_block)   /* side of the blocks of `limits`, pixels; 0: there are no limits */
LW_PUSH_CONSTANTS(TemporalMeanParams, LW_TEMPORAL_MEAN_PARAMS)

#endif
