// Object space to world space: parameters and elements shared with world_vertices.comp.
#ifndef LIGHTWELL_WORLD_VERTICES_H
#define LIGHTWELL_WORLD_VERTICES_H

#include "shaders/shared.h"

#define LW_WORLD_VERTICES_PARAMS(MEMBER) \
  MEMBER(uint, first_vertex)             \
  MEMBER(uint, vertex_count)             \
  MEMBER(uint, first_frame) /* 1: there are no previous positions yet */
LW_PUSH_CONSTANTS(WorldVerticesParams, LW_WORLD_VERTICES_PARAMS)

#define LW_OBJECT_VERTEX(MEMBER) \
  MEMBER(vec3, position)         \
  MEMBER(float, u)               \
  MEMBER(vec3, normal)           \
  MEMBER(float, v)               \
  MEMBER(vec4, uv1) /* xy: the second pair; zw: bits of the color that go to WorldVertex, 0 for white */
LW_STRUCT(ObjectVertex, LW_OBJECT_VERTEX)

// The joints that move an object vertex.
#define LW_INFLUENCE(MEMBER)        \
  MEMBER(vec4, weights) /* sum 1 */ \
  MEMBER(uvec4, joints) /* of the instance's */
LW_STRUCT(Influence, LW_INFLUENCE)

// What a morph target adds to an object vertex.
#define LW_MORPH_OFFSET(MEMBER)    \
  MEMBER(vec4, position) /* xyz */ \
  MEMBER(vec4, normal)   /* xyz */
LW_STRUCT(MorphOffset, LW_MORPH_OFFSET)

// One primitive of one instance in its pose; rows of the 3x4 matrix to the world, for vertices that no joints move.
#define LW_PART(MEMBER)                                                       \
  MEMBER(vec4, row_0)                                                         \
  MEMBER(vec4, row_1)                                                         \
  MEMBER(vec4, row_2)                                                         \
  MEMBER(uint, material)                                                      \
  MEMBER(float, handedness) /* -1 where the instance mirrors, else 1 */       \
  MEMBER(uint, skin_count)  /* 1: joints move the vertices; 0: they do not */ \
  MEMBER(uint, morph_count) /* morph targets whose weights are not 0 */       \
  MEMBER(uint, first_object_vertex)                                           \
  MEMBER(uint, first_influence)                                               \
  MEMBER(uint, first_joint)                                                   \
  MEMBER(uint, first_morph)
LW_STRUCT(Part, LW_PART)

// Rows of a joint's 3x4 matrix from the bind pose to the world.
#define LW_JOINT(MEMBER) \
  MEMBER(vec4, row_0)    \
  MEMBER(vec4, row_1)    \
  MEMBER(vec4, row_2)
LW_STRUCT(Joint, LW_JOINT)

// A morph target at work in a part.
#define LW_MORPH(MEMBER) MEMBER(float, weight) MEMBER(uint, first_offset)
LW_STRUCT(Morph, LW_MORPH)

// Where a world vertex comes from.
#define LW_VERTEX_SOURCE(MEMBER) MEMBER(uint, object_vertex) MEMBER(uint, part)
LW_STRUCT(VertexSource, LW_VERTEX_SOURCE)

#endif
