// Light paths: what of the Sobol sequence they use.
#ifndef LIGHTWELL_LIGHT_PATH_DIMENSIONS_H
#define LIGHTWELL_LIGHT_PATH_DIMENSIONS_H

#include "shaders/shared.h"

// Dimensions that are stratified together: a path's start and its ways to surfaces 2 and 3.
LW_CONSTANT(uint, kJointDimensions, 10)

#endif
