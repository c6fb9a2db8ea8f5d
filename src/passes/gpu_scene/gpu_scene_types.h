// Elements of the scene's buffers, shared with the shaders.
#ifndef LIGHTWELL_GPU_SCENE_TYPES_H
#define LIGHTWELL_GPU_SCENE_TYPES_H

#include "shaders/shared.h"

// The first pair of texture coordinates is the base colour's, the second the emission's, whichever sets of the
// primitive they are. What the vertex colour is short of white is in bits that white leaves alone
// (shaders/vertex_color.glsl): material index + 65536 * (upper six bits of blue's, 64 * alpha's), and a float that is
// -1 where the instance mirrors, else 1, with its lower 30 bits changed by red's + 4096 * green's + 16777216 * (lower
// six bits of blue's).
#define LW_WORLD_VERTEX(MEMBER)                                                                  \
  MEMBER(vec4, position_material) /* xyz: world position; w: uintBitsToFloat(material, color) */ \
  MEMBER(vec4, normal_u)          /* xyz: unit world normal, or 0; w: u of the first pair */     \
  MEMBER(vec4, v_uv1)             /* x: v of the first pair; yz: the second; w: handedness, color */
LW_STRUCT(WorldVertex, LW_WORLD_VERTEX)

// Indices of materials fit 16 bits: of the scene's at most so many, and of the default one behind them.
LW_CONSTANT(uint, kMaxMaterials, 65535)

// A texture slot is array * 65536 + layer.
LW_CONSTANT(uint, kNoTexture, 0xffffffffu)

// Transforms are the two rows of the 2x3 matrix, xyz
// each; base_transform_0.w = pair of texture coordinates + 2 * wrap_u + 8 * wrap_v + 32 * nearest (wrap: enum Wrap),
// base_transform_1.w = the texture's own width + 4096 * height, 2048 at most each; likewise for emission.
#define LW_GPU_MATERIAL(MEMBER)                                                \
  MEMBER(vec4, base_color)                                                     \
  MEMBER(vec4, emission) /* xyz W/(sr m^2); w: 1 if emitted from both sides */ \
  MEMBER(vec4, base_transform_0)                                               \
  MEMBER(vec4, base_transform_1)                                               \
  MEMBER(vec4, emission_transform_0)                                           \
  MEMBER(vec4, emission_transform_1)                                           \
  MEMBER(uint, base_texture)                                                   \
  MEMBER(uint, emission_texture)                                               \
  MEMBER(float, alpha_cutoff) /* 0: opaque */                                  \
  MEMBER(uint, unused)
LW_STRUCT(GpuMaterial, LW_GPU_MATERIAL)

#endif
