// One binary node a triangle, in the order of the codes. A binary node is two vec4: `lows`: low corner, left child;
// `highs`: high corner, right child; of a triangle: its index in the scene, kBvhNothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
LW_PAGED_READ(0, 2, uvec2, keys)
LW_PAGED_WRITE(0, 3, uvec4, lows)
LW_PAGED_WRITE(0, 4, uvec4, highs)
LW_PAGED_WRITE(0, 5, uint, clusters)

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_corners.glsl"

void main() {
  uint leaf = linear_invocation();
  if (leaf >= params.count) return;
  uint triangle = scene_triangle(keys_at(leaf).y);
  Corners c = load_corners(triangle);
  lows_store(leaf, uvec4(floatBitsToUint(low_corner(c)), triangle));
  highs_store(leaf, uvec4(floatBitsToUint(high_corner(c)), kBvhNothing));
  clusters_store(leaf, leaf);
}
