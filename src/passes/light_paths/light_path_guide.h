// Guided starts of light paths: what host and kernels share.
#ifndef LIGHTWELL_PASSES_LIGHT_PATH_GUIDE_H
#define LIGHTWELL_PASSES_LIGHT_PATH_GUIDE_H

#include "shaders/shared.h"

// A source's strata: cells of the square of the two numbers that choose the direction from a point or spot light, the
// place on an emitter, the place where a ray of a sun or of the environment enters the scene.
LW_CONSTANT(uint, kGuideSide, 32)
LW_CONSTANT(uint, kGuideStrata, kGuideSide* kGuideSide)
LW_CONSTANT(uint, kMostGuidedSources, 64)
LW_CONSTANT(uint, kNoStratum, 0xffffffff)

// Of a source in the table: the running sum of all rows' importance, then that of each row's strata.
LW_CONSTANT(uint, kGuideFloats, kGuideSide + kGuideStrata)

// Part of the paths that start as if there were no guide.
LW_CONSTANT(float, kUnguidedPart, 0.2f)

#endif
