// Photons on their way to a surface, as host and kernels see them.
#ifndef LIGHTWELL_PHOTON_SPLATTING_SPLAT_TYPES_H
#define LIGHTWELL_PHOTON_SPLATTING_SPLAT_TYPES_H

#include "shaders/shared.h"

// A bundle of photons on one ray, at the end of it: what it lights is what its orthographic shadow map sees along the
// ray, up to `reach` before and behind the end.
#define LW_SPLAT(MEMBER)                                                                                  \
  MEMBER(vec3, center)      /* m, where the ray ends */                                                   \
  MEMBER(float, half_width) /* m, of its kernel and map, across the ray */                                \
  MEMBER(vec3, direction)   /* unit, of the ray */                                                        \
  MEMBER(float, reach)      /* m, along the ray to both sides of the center */                            \
  MEMBER(vec3, flux)        /* W of all its photons; 0: there is no splat */                              \
  MEMBER(float, photons)    /* how many they are */                                                       \
  MEMBER(float, accepted)   /* part of its kernel whose texels met a surface that it may light; (0, 1] */ \
  MEMBER(uint, map)         /* its number in the atlas of shadow maps, which is its own */                \
  MEMBER(uint, normal)      /* of the surface at the center, packed: shaders/light_point.glsl */
LW_STRUCT(Splat, LW_SPLAT)

// The same as it lies in memory; only splat_storage.glsl reads and writes it. Lengths: floats of 16 bits, 8 of them the
// exponent's.
#define LW_STORED_SPLAT(MEMBER)                                                                      \
  MEMBER(vec3, center)    /* m */                                                                    \
  MEMBER(uint, direction) /* packed as the normal */                                                 \
  MEMBER(uint, normal)                                                                               \
  MEMBER(uint, lengths) /* half width, reach */                                                      \
  MEMBER(uint, colors)  /* of the flux: 3 * 10 bits in units of 2^(exponent - 136) W; 2 bits free */ \
  MEMBER(uint, parts)   /* the exponent, 8 bits; 1024 * accepted, 11; photons: mantissa 8, exponent 4; 1 free */
LW_STRUCT(StoredSplat, LW_STORED_SPLAT)

#endif
