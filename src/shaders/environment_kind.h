// What light comes from outside: constant of kernels that sample it (GpuEnvironment::kind()).
#ifndef LIGHTWELL_SHADERS_ENVIRONMENT_KIND_H
#define LIGHTWELL_SHADERS_ENVIRONMENT_KIND_H

#include "shaders/shared.h"

LW_CONSTANT(uint, kEnvironmentBlack, 0)
LW_CONSTANT(uint, kEnvironmentConstant, 1)
LW_CONSTANT(uint, kEnvironmentMap, 2)

#endif
