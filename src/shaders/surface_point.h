// A place on a surface: where irradiance is looked up.
#ifndef LIGHTWELL_SHADERS_SURFACE_POINT_H
#define LIGHTWELL_SHADERS_SURFACE_POINT_H

#include "shaders/shared.h"

#define LW_SURFACE_POINT(MEMBER)                                \
  MEMBER(vec4, position) /* xyz: m; w: 0 where there is none */ \
  MEMBER(vec4, normal)   /* xyz: unit, towards the side that is lit */
LW_STRUCT(SurfacePoint, LW_SURFACE_POINT)

#endif
