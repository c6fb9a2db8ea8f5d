// The table of emissive triangles: elements shared with the kernels.
#ifndef LIGHTWELL_EMITTERS_H
#define LIGHTWELL_EMITTERS_H

#include "shaders/shared.h"

// EmissiveTriangle::flags
LW_CONSTANT(uint, kEmitsFromBothSides, 1)
LW_CONSTANT(uint, kEmitterMirrored, 2)  // the edges are swapped: those of the triangle's third and second corner
LW_CONSTANT(uint, kEmitterLooksUp, 4)   // emission has a texture, or an alpha mask

// The front is the side that edge_1 x edge_2 points to.
#define LW_EMISSIVE_TRIANGLE(MEMBER)                                                             \
  MEMBER(vec3, corner)                                                                           \
  MEMBER(float, power_so_far) /* of the triangles of its group of 64, up to and with this one */ \
  MEMBER(vec3, edge_1)                                                                           \
  MEMBER(uint, triangle) /* of the scene */                                                      \
  MEMBER(vec3, edge_2)                                                                           \
  MEMBER(float, luminance) /* by which it is chosen: power = area * luminance */                 \
  MEMBER(vec3, emission)   /* W/(sr m^2), without its texture */                                 \
  MEMBER(uint, flags)
LW_STRUCT(EmissiveTriangle, LW_EMISSIVE_TRIANGLE)

LW_CONSTANT(uint, kEmitterGroup, 64)

// A group of kEmitterGroup triangles. After the last group stands one for the whole, whose power_before is all power.
#define LW_EMITTER_GROUP(MEMBER) \
  MEMBER(vec3, low) /* bounds */ \
  MEMBER(float, power_before)    \
  MEMBER(vec3, high)             \
  MEMBER(float, least_luminance) /* of any triangle's emission without its texture */
LW_STRUCT(EmitterGroup, LW_EMITTER_GROUP)

#endif
