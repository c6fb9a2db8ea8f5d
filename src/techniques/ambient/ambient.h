// Parameters of the ambient kernel.
#ifndef LIGHTWELL_AMBIENT_H
#define LIGHTWELL_AMBIENT_H

#include "shaders/shared.h"

#define LW_AMBIENT_PARAMS(MEMBER) MEMBER(uvec2, size) MEMBER(float, irradiance)
LW_PUSH_CONSTANTS(AmbientParams, LW_AMBIENT_PARAMS)

#endif
