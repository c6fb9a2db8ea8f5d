// Where photons should start: what host and kernels share.
#ifndef LIGHTWELL_PHOTON_SPLATTING_GUIDE_TYPES_H
#define LIGHTWELL_PHOTON_SPLATTING_GUIDE_TYPES_H

#include "shaders/shared.h"

#define LW_GUIDE_UPDATE_PARAMS(MEMBER)                           \
  MEMBER(float, keep)    /* of the sums so far, in each frame */ \
  MEMBER(float, counted) /* 1: last frame's counts are of these lights, else 0 */

#ifdef __cplusplus  // each kernel declares the one that it has
LW_PUSH_CONSTANTS(GuideUpdateParams, LW_GUIDE_UPDATE_PARAMS)
#endif

#endif
