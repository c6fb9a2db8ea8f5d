// A point on a surface that light leaves, cosine-distributed about the normal of its triangle: a virtual point light,
// or a photon at rest. (Radiance is the same in all directions, so power is distributed by the cosine to the surface as
// it is; interpolated normals count where light arrives.)
#ifndef LIGHTWELL_SHADERS_LIGHT_POINT_H
#define LIGHTWELL_SHADERS_LIGHT_POINT_H

#include "shaders/shared.h"

#define LW_LIGHT_POINT(MEMBER)                                                            \
  MEMBER(vec3, position) /* m; a hair above its surface, where shadow rays may end */     \
  MEMBER(uint, normal)   /* unit, packed: shaders/light_point.glsl */                     \
  MEMBER(vec3, flux)     /* W that leaves the surface; 0 where there is no light point */ \
  MEMBER(uint, bounces)  /* surfaces that the light has met on its way, this one included: 1, ... */
LW_STRUCT(LightPoint, LW_LIGHT_POINT)

#endif
