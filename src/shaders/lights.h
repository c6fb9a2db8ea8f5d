// Lights as the shaders see them. One element of the storage buffer `lights` of every pass that lights anything:
//   layout(set = 0, binding = n) readonly buffer LightBuffer { GpuLight data[]; } lights;
#ifndef LIGHTWELL_SHADERS_LIGHTS_H
#define LIGHTWELL_SHADERS_LIGHTS_H

#include "shaders/shared.h"

// GpuLight::type
LW_CONSTANT(uint, kLightPoint, 0)
LW_CONSTANT(uint, kLightSpot, 1)
LW_CONSTANT(uint, kLightDirectional, 2)

// GpuLight::shadow_kind
LW_CONSTANT(uint, kShadowNone, 0)
LW_CONSTANT(uint, kShadowSingle, 1)  // one view: perspective for spots, orthographic for directional lights
LW_CONSTANT(uint, kShadowCube, 2)    // six faces: point lights and spots too wide for one view
LW_CONSTANT(uint, kShadowNested, 3)  // two views of a directional light: a fine one within one of the whole scene

// Texels round a tile that are drawn but never at the centre of a filter: a filter near the edge stays in its tile.
LW_CONSTANT(uint, kShadowGuard, 4)

#define LW_GPU_LIGHT(MEMBER)                                                                                 \
  MEMBER(vec3, position)  /* m; point and spot */                                                            \
  MEMBER(uint, type)      /* kLight... */                                                                    \
  MEMBER(vec3, direction) /* unit, from the light; spot and directional */                                   \
  MEMBER(float, cos_inner)                                                                                   \
  MEMBER(vec3, intensity) /* W/sr; directional: W/m^2 perpendicular to the light */                          \
  MEMBER(float, cos_outer)                                                                                   \
  MEMBER(mat4, to_shadow)   /* world to shadow clip space; cube: view of one face to its clip space */       \
  MEMBER(uint, shadow_kind) /* kShadow... */                                                                 \
  MEMBER(uint, tile_side)   /* of one view, texels, guard included */                                        \
  MEMBER(uvec2, tile)       /* upper left texel in the atlas; views follow: 3 in a row, 2 rows */            \
  MEMBER(vec4, coarse)      /* nested: xy of the coarse view = xy of the fine one * coarse.xy + coarse.zw */ \
  MEMBER(float, texel_size) /* world side of a shadow texel in m; cube and spot: at 1 m along the view */    \
  MEMBER(uint, unused_0)                                                                                     \
  MEMBER(uint, unused_1)                                                                                     \
  MEMBER(uint, unused_2)
LW_STRUCT(GpuLight, LW_GPU_LIGHT)

#endif
