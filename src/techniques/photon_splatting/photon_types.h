// From light points to splats and their maps: what host and kernels share.
#ifndef LIGHTWELL_PHOTON_SPLATTING_PHOTON_TYPES_H
#define LIGHTWELL_PHOTON_SPLATTING_PHOTON_TYPES_H

#include "shaders/shared.h"

// Words of the counts of splats.
LW_CONSTANT(uint, kSplatsInUse, 0)
LW_CONSTANT(uint, kSplatGroups, 1)  // indirect dispatch of an invocation a splat
LW_CONSTANT(uint, kTexelGroups, 4)  // of one a texel of their maps
LW_CONSTANT(uint, kSplatCountWords, 7)

// Words of the counts of light points: of all, and of each bounce.
LW_CONSTANT(uint, kPointsInAll, 0)
LW_CONSTANT(uint, kPointsOfBounce, 1)
LW_CONSTANT(uint, kPhotonBounces, 8)  // at most
LW_CONSTANT(uint, kPointCountWords, kPointsOfBounce + kPhotonBounces)

// Where a splat's photon came from.
#define LW_PHOTON_START(MEMBER)  \
  MEMBER(vec3, position) /* m */ \
  MEMBER(uint, normal)   /* of the surface, packed: shaders/light_point.glsl */
LW_STRUCT(PhotonStart, LW_PHOTON_START)

#endif
