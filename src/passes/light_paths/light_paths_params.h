// Light paths: parameters that their kernels share.
#ifndef LIGHTWELL_PASSES_LIGHT_PATHS_H
#define LIGHTWELL_PASSES_LIGHT_PATHS_H

#include "passes/light_paths/light_path_dimensions.h"

// kSequence
LW_CONSTANT(uint, kSequenceHalton, 0)
LW_CONSTANT(uint, kSequenceSobol, 1)

// kEnvironment
LW_CONSTANT(uint, kSkyBlack, 0)
LW_CONSTANT(uint, kSkyConstant, 1)
LW_CONSTANT(uint, kSkyMap, 2)

#define LW_LIGHT_PATHS_PARAMS(MEMBER)                                                               \
  MEMBER(vec3, low) /* of the scene's bounds, m, with some room */                                  \
  MEMBER(uint, path_count)                                                                          \
  MEMBER(vec3, high)                                                                                \
  MEMBER(uint, first_path)  /* of the sequence */                                                   \
  MEMBER(uvec2, table_size) /* of the environment */                                                \
  MEMBER(uint, light_count)                                                                         \
  MEMBER(uint, emitter_count)                                                                       \
  MEMBER(uvec3, bases)    /* of a bounce's dimensions: two of the direction, one of roulette */     \
  MEMBER(uint, bounce)    /* the surface that paths go to: 1 for the first */                       \
  MEMBER(uint, top_level) /* of the maps' luminance: where a tile is one texel */                   \
  MEMBER(uint, aim_count) /* balls about `focus`, each aim_ratio times as wide as the one before */ \
  MEMBER(float, aim_ratio)                                                                          \
  MEMBER(float, aim_radius) /* of the finest, m */                                                  \
  MEMBER(vec3, focus)
LW_PUSH_CONSTANTS(LightPathsParams, LW_LIGHT_PATHS_PARAMS)

#endif
