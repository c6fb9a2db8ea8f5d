// Deferred direct light: parameters shared with direct.comp and direct_rays.comp.
#ifndef LIGHTWELL_PASSES_DIRECT_H
#define LIGHTWELL_PASSES_DIRECT_H

#include "shaders/shared.h"

#define LW_DIRECT_PARAMS(MEMBER)                                                                             \
  MEMBER(uvec2, size)                                                                                        \
  MEMBER(uint, light_count)                                                                                  \
  MEMBER(uint, has_sampled) /* `sampled` holds more direct light: that of emitters and of the environment */ \
  MEMBER(float, clearance)  /* of rays above the surface, m for each metre from the camera */
LW_PUSH_CONSTANTS(DirectParams, LW_DIRECT_PARAMS)

#endif
