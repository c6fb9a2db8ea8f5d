// Parameters of the published preset's kernels.
#ifndef LIGHTWELL_PHOTON_SPLATTING_PAPER_TYPES_H
#define LIGHTWELL_PHOTON_SPLATTING_PAPER_TYPES_H

#include "shaders/shared.h"

#define LW_PAPER_NORMALISE_PARAMS(MEMBER) MEMBER(uvec2, size) MEMBER(float, exposure) MEMBER(float, ambient)
#define LW_PAPER_BLUR_PARAMS(MEMBER)                \
  MEMBER(uvec2, size)                               \
  MEMBER(ivec2, step) /* from tap to tap, pixels */ \
  MEMBER(int, radius) /* taps to either side */

#ifdef __cplusplus  // each kernel declares the one that it has
LW_PUSH_CONSTANTS(PaperNormaliseParams, LW_PAPER_NORMALISE_PARAMS)
LW_PUSH_CONSTANTS(PaperBlurParams, LW_PAPER_BLUR_PARAMS)
#endif

#endif
