// Morton codes of the triangles (Morton 1966): 10 bits an axis. All axes share one scale, so that flat scenes spend no
// bits on their height.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 2) readonly buffer StateBuffer { uint data[]; } state;
LW_PAGED_WRITE(0, 3, uvec2, keys)  // code, item

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_corners.glsl"
#include "passes/trace/bvh_order.glsl"

// Two zero bits before each of ten.
uint spread_bits(uint x) {
  x = (x * 0x00010001u) & 0xff0000ffu;
  x = (x * 0x00000101u) & 0x0f00f00fu;
  x = (x * 0x00000011u) & 0xc30c30c3u;
  return (x * 0x00000005u) & 0x49249249u;
}

void main() {
  uint item = linear_invocation();
  if (item >= params.count) return;
  vec3 low, high;
  for (uint axis = 0; axis < 3; ++axis) {
    low[axis] = from_ordered(state.data[kBvhBounds + axis]);
    high[axis] = from_ordered(state.data[kBvhBounds + 3 + axis]);
  }
  vec3 size = high - low;
  float side = max(max(size.x, size.y), size.z);
  vec3 part = side > 0.0 ? (box_center(load_corners(scene_triangle(item))) - low) / side : vec3(0.0);
  uvec3 cell = uvec3(clamp(part * 1024.0, vec3(0.0), vec3(1023.0)));
  keys_store(item, uvec2(spread_bits(cell.x) << 2 | spread_bits(cell.y) << 1 | spread_bits(cell.z), item));
}
