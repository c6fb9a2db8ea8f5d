// Copies the triangles' corners into the leaves.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 2) buffer TriangleBuffer { uvec4 data[]; } triangles;

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_corners.glsl"

void main() {
  uint slot = linear_invocation();
  if (slot >= params.count) return;
  uint first = kBvhTriangleWords * (params.slot_first + slot);
  uint triangle = triangles.data[first].w;
  Corners c = load_corners(triangle);
  triangles.data[first] = uvec4(floatBitsToUint(c.p[0]), triangle);
  triangles.data[first + 1] = uvec4(floatBitsToUint(c.p[1]), 0);
  triangles.data[first + 2] = uvec4(floatBitsToUint(c.p[2]), 0);
}
