// What cosine_directions.comp is asked.
#ifndef LIGHTWELL_SAMPLED_LIGHTS_TESTING_COSINE_DIRECTIONS_H
#define LIGHTWELL_SAMPLED_LIGHTS_TESTING_COSINE_DIRECTIONS_H

#include "shaders/shared.h"

#define LW_COSINE_QUESTION(MEMBER) \
  MEMBER(vec3, normal)             \
  MEMBER(uint, unused)             \
  MEMBER(vec2, numbers)            \
  MEMBER(uvec2, unused_too)
LW_STRUCT(CosineQuestion, LW_COSINE_QUESTION)

#define LW_COSINE_DIRECTIONS_PARAMS(MEMBER) MEMBER(uint, count)
LW_PUSH_CONSTANTS(CosineDirectionsParams, LW_COSINE_DIRECTIONS_PARAMS)

#endif
