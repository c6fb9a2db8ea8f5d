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
  MEMBER(vec4, uv1) /* xy: set 1; zw: unused */
LW_STRUCT(ObjectVertex, LW_OBJECT_VERTEX)

// One primitive of one instance; rows of the 3x4 matrix to the world.
#define LW_PART(MEMBER)                                               \
  MEMBER(vec4, row_0)                                                 \
  MEMBER(vec4, row_1)                                                 \
  MEMBER(vec4, row_2)                                                 \
  MEMBER(uint, material)                                              \
  MEMBER(float, handedness) /* -1 where the matrix mirrors, else 1 */ \
  MEMBER(uint, unused_0)                                              \
  MEMBER(uint, unused_1)
LW_STRUCT(Part, LW_PART)

// Where a world vertex comes from.
#define LW_VERTEX_SOURCE(MEMBER) MEMBER(uint, object_vertex) MEMBER(uint, part)
LW_STRUCT(VertexSource, LW_VERTEX_SOURCE)

#endif
