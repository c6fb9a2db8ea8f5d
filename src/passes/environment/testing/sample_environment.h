// Samples of an environment's table: parameters and elements shared with sample_environment.comp.
#ifndef LIGHTWELL_ENVIRONMENT_TESTING_SAMPLE_H
#define LIGHTWELL_ENVIRONMENT_TESTING_SAMPLE_H

#include "shaders/shared.h"

#define LW_TABLE_TEST_PARAMS(MEMBER) MEMBER(uvec2, table_size) MEMBER(uint, count)
LW_PUSH_CONSTANTS(TableTestParams, LW_TABLE_TEST_PARAMS)

#define LW_TABLE_TEST_SAMPLE(MEMBER)                                                \
  MEMBER(vec3, direction)                                                           \
  MEMBER(float, density)       /* as the sample says */                             \
  MEMBER(float, density_again) /* as environment_density() says of its direction */ \
  MEMBER(float, unused_0)                                                           \
  MEMBER(float, unused_1)                                                           \
  MEMBER(float, unused_2)
LW_STRUCT(TableTestSample, LW_TABLE_TEST_SAMPLE)

#endif
