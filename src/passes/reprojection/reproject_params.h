// Reprojection: parameters shared with reproject.comp.
#ifndef LIGHTWELL_REPROJECT_PARAMS_H
#define LIGHTWELL_REPROJECT_PARAMS_H

#include "shaders/shared.h"

#define LW_REPROJECT_PARAMS(MEMBER)                                            \
  MEMBER(uvec2, size)                                                          \
  MEMBER(uint, has_history)     /* 0: every tap is rejected */                 \
  MEMBER(float, pixel_tangent)  /* side of a pixel 1 m before the camera, m */ \
  MEMBER(vec3, camera_position) /* m */
LW_PUSH_CONSTANTS(ReprojectParams, LW_REPROJECT_PARAMS)

#endif
