// Traced samples of direct light: parameters shared with sample_lights.comp.
#ifndef LIGHTWELL_SAMPLED_LIGHTS_SAMPLE_H
#define LIGHTWELL_SAMPLED_LIGHTS_SAMPLE_H

#include "shaders/shared.h"

// kEnvironment
LW_CONSTANT(uint, kEnvironmentBlack, 0)
LW_CONSTANT(uint, kEnvironmentConstant, 1)
LW_CONSTANT(uint, kEnvironmentMap, 2)

#define LW_SAMPLE_LIGHTS_PARAMS(MEMBER)                       \
  MEMBER(uvec2, size)                                         \
  MEMBER(uvec2, table_size) /* of the environment */          \
  MEMBER(uint, emitter_count)                                 \
  MEMBER(uint, samples)      /* of each kind */               \
  MEMBER(uint, first_sample) /* of every pixel's sequences */ \
  MEMBER(float, clearance)   /* of rays, per metre of distance from the camera */
LW_PUSH_CONSTANTS(SampleLightsParams, LW_SAMPLE_LIGHTS_PARAMS)

#endif
