// Bounds of every kTriangleGroup neighbouring triangles, one invocation for all of them; triangles that are not finite are left out.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxelize/voxelize_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) writeonly buffer GroupBoundsBuffer { vec4 data[]; } group_bounds;

#include "shaders/finite.glsl"
#include "shaders/geometry.glsl"
#include "shaders/linear_dispatch.glsl"

void main() {
  uint group = linear_invocation();
  uint first = group * kTriangleGroup;
  if (first >= params.triangles.count) return;
  uint end = min(first + kTriangleGroup, params.triangles.count);
  vec3 low = vec3(3e38);
  vec3 high = vec3(-3e38);
  for (uint i = first; i < end; ++i) {
    Triangle source = load_triangle(chosen_triangle(params.triangles, i));
    vec3 a = vertex_position(source.v[0]);
    vec3 b = vertex_position(source.v[1]);
    vec3 c = vertex_position(source.v[2]);
    bool counts = is_finite(a) && is_finite(b) && is_finite(c);
    low = counts ? min(low, min(min(a, b), c)) : low;
    high = counts ? max(high, max(max(a, b), c)) : high;
  }
  group_bounds.data[2 * group] = vec4(low, 0.0);
  group_bounds.data[2 * group + 1] = vec4(high, 0.0);
}
