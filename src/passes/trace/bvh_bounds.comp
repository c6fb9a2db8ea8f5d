// Bounds of the centres of the triangles' boxes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 2) buffer StateBuffer { uint data[]; } state;

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_corners.glsl"
#include "passes/trace/bvh_order.glsl"

void main() {
  uint first = linear_invocation() * kBvhBoundsBlock;
  if (first >= params.count) return;
  uint end = min(first + kBvhBoundsBlock, params.count);
  vec3 low = box_center(load_corners(scene_triangle(first)));
  vec3 high = low;
  for (uint i = first + 1; i < end; ++i) {
    vec3 center = box_center(load_corners(scene_triangle(i)));
    low = min(low, center);
    high = max(high, center);
  }
  for (uint axis = 0; axis < 3; ++axis) {
    atomicMin(state.data[kBvhBounds + axis], to_ordered(low[axis]));
    atomicMax(state.data[kBvhBounds + 3 + axis], to_ordered(high[axis]));
  }
}
