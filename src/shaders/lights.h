// Lights as the shaders see them. One element of the storage buffer `lights` of every pass that lights anything:
//   layout(set = 0, binding = n) readonly buffer LightBuffer { GpuLight data[]; } lights;
#ifndef LIGHTWELL_SHADERS_LIGHTS_H
#define LIGHTWELL_SHADERS_LIGHTS_H

#include "shaders/shared.h"

// GpuLight::type
LW_CONSTANT(uint, kLightPoint, 0)
LW_CONSTANT(uint, kLightSpot, 1)
LW_CONSTANT(uint, kLightDirectional, 2)

#define LW_GPU_LIGHT(MEMBER)                                                        \
  MEMBER(vec3, position)  /* m; point and spot */                                   \
  MEMBER(uint, type)      /* kLight... */                                           \
  MEMBER(vec3, direction) /* unit, from the light; spot and directional */          \
  MEMBER(float, cos_inner)                                                          \
  MEMBER(vec3, intensity) /* W/sr; directional: W/m^2 perpendicular to the light */ \
  MEMBER(float, cos_outer)                                                          \
  MEMBER(vec3, unused)                                                              \
  MEMBER(float, inverse_range) /* 1/m; 0: none */
LW_STRUCT(GpuLight, LW_GPU_LIGHT)

#endif
