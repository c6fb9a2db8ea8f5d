// Traced samples of direct light: parameters shared with sample_lights.comp.
#ifndef LIGHTWELL_SAMPLED_LIGHTS_SAMPLE_H
#define LIGHTWELL_SAMPLED_LIGHTS_SAMPLE_H

#include "shaders/environment_kind.h"

#define LW_SAMPLE_LIGHTS_PARAMS(MEMBER)                       \
  MEMBER(uvec2, size)                                         \
  MEMBER(uvec2, table_size) /* of the environment */          \
  MEMBER(uint, emitter_count)                                 \
  MEMBER(uint, samples)      /* of each kind */               \
  MEMBER(uint, first_sample) /* of every pixel's sequences */ \
  MEMBER(float, clearance)   /* of rays, per metre of distance from the camera */
LW_PUSH_CONSTANTS(SampleLightsParams, LW_SAMPLE_LIGHTS_PARAMS)

#endif
