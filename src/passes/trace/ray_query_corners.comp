// Writes the corners of triangles one after the other, as acceleration structures are built from them. Triangles with a
// corner that is not a finite number become points: rays never meet them, devices need not cope with them, and they may
// become finite again without a new build (to which NaN would be a change of the number of triangles).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/ray_query_corners_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
LW_PAGED_WRITE(0, 2, float, corners)

#include "shaders/finite.glsl"
#include "shaders/geometry.glsl"
#include "shaders/linear_dispatch.glsl"

void main() {
  uint index = linear_invocation();
  if (index >= params.count) return;
  uint triangle = params.first + index;
  if (triangle >= params.gap_first) triangle += params.gap_count;
  vec3 corner[3];
  for (uint i = 0; i < 3; ++i) corner[i] = scene_position(scene_index(3 * triangle + i));
  bool finite = is_finite(corner[0]) && is_finite(corner[1]) && is_finite(corner[2]);
  for (uint i = 0; i < 3; ++i)
    for (uint axis = 0; axis < 3; ++axis) corners_store(9 * index + 3 * i + axis, finite ? corner[i][axis] : 0.0);
}
