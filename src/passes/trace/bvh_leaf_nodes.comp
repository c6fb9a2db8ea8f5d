// One binary node a triangle, in the order of the codes. A binary node is two vec4: `lows`: low corner, left child;
// `highs`: high corner, right child; of a triangle: its index in the scene, kBvhNothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 2) readonly buffer KeyBuffer { uvec2 data[]; } keys;
layout(set = 0, binding = 3) writeonly buffer LowBuffer { uvec4 data[]; } lows;
layout(set = 0, binding = 4) writeonly buffer HighBuffer { uvec4 data[]; } highs;
layout(set = 0, binding = 5) writeonly buffer ClusterBuffer { uint data[]; } clusters;

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_corners.glsl"

void main() {
  uint leaf = linear_invocation();
  if (leaf >= params.count) return;
  uint triangle = scene_triangle(keys.data[leaf].y);
  Corners c = load_corners(triangle);
  lows.data[leaf] = uvec4(floatBitsToUint(low_corner(c)), triangle);
  highs.data[leaf] = uvec4(floatBitsToUint(high_corner(c)), kBvhNothing);
  clusters.data[leaf] = leaf;
}
