// Copies the triangles' corners into the leaves.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
LW_PAGED_READ_WRITE(restrict, 0, 2, uvec4, triangles)

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_corners.glsl"

void main() {
  uint slot = linear_invocation();
  if (slot >= params.count) return;
  uint first = kBvhTriangleWords * (params.slot_first + slot);
  uint triangle = triangles_at(first).w;
  Corners c = load_corners(triangle);
  triangles_store(first, uvec4(floatBitsToUint(c.p[0]), triangle));
  triangles_store(first + 1, uvec4(floatBitsToUint(c.p[1]), 0));
  triangles_store(first + 2, uvec4(floatBitsToUint(c.p[2]), 0));
}
