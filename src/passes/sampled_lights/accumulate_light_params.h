// Mean over frames: parameters shared with accumulate_light.comp.
#ifndef LIGHTWELL_SAMPLED_LIGHTS_ACCUMULATE_H
#define LIGHTWELL_SAMPLED_LIGHTS_ACCUMULATE_H

#include "shaders/shared.h"

#define LW_ACCUMULATE_LIGHT_PARAMS(MEMBER)                                     \
  MEMBER(uvec2, size)                                                          \
  MEMBER(uint, fresh)           /* 1: there is no history */                   \
  MEMBER(float, most_frames)    /* that the history counts for */              \
  MEMBER(vec3, camera_position) /* m */                                        \
  MEMBER(float, pixel_tangent)  /* side of a pixel 1 m before the camera, m */ \
  MEMBER(float, eagerness)      /* weight of a frame among n: eagerness / (n - 1 + eagerness) */
LW_PUSH_CONSTANTS(AccumulateLightParams, LW_ACCUMULATE_LIGHT_PARAMS)

#endif
