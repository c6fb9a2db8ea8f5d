// Photons on their way to a surface, as host and kernels see them.
#ifndef LIGHTWELL_PHOTON_SPLATTING_SPLAT_TYPES_H
#define LIGHTWELL_PHOTON_SPLATTING_SPLAT_TYPES_H

#include "shaders/shared.h"

// A bundle of photons on one ray, at the end of it: what it lights is what its orthographic shadow map sees along the
// ray, up to `reach` before and behind the end.
#define LW_SPLAT(MEMBER)                                                                                 \
  MEMBER(vec3, center)      /* m, where the ray ends */                                                  \
  MEMBER(float, half_width) /* m, of its kernel and map, across the ray */                               \
  MEMBER(vec3, direction)   /* unit, of the ray */                                                       \
  MEMBER(float, reach)      /* m, along the ray to both sides of the center */                           \
  MEMBER(vec3, flux)        /* W of all its photons; 0: there is no splat */                             \
  MEMBER(float, photons)    /* how many they are */                                                      \
  MEMBER(uint, map)         /* its number in the atlas of shadow maps */                                 \
  MEMBER(float, accepted)   /* part of its map's texels that met a surface which it may light; (0, 1] */ \
  MEMBER(uint, normal)      /* of the surface at the center, packed: shaders/light_point.glsl */         \
  MEMBER(uint, bounces)     /* surfaces that its light has met, that at the center not counted */
LW_STRUCT(Splat, LW_SPLAT)

#endif
