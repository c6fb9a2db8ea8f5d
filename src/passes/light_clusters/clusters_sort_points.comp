// Puts the points into the clusters' order, and counts how many clusters there would be for each number of key bits
// that do not count.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_clusters/light_clusters_params.h"
#include "shaders/light_point.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer KeyBuffer { uvec2 data[]; } keys;
layout(set = 0, binding = 1) readonly buffer PointBuffer { LightPoint data[]; } points;
layout(set = 0, binding = 2) writeonly buffer SortedBuffer { LightPoint data[]; } sorted_points;
layout(set = 0, binding = 3) buffer CountBuffer { uint data[]; } counts;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint index = linear_invocation();
  if (index >= params.point_count) return;
  uvec2 key = keys.data[index];
  sorted_points.data[index] = points.data[key.y];
  if (key.x == kNoClusterKey) return;
  uint before = index > 0 ? keys.data[index - 1].x : kNoClusterKey;
  for (uint i = 0; i < kClusterShifts; ++i)
    if (key.x >> (3 * i) != before >> (3 * i)) atomicAdd(counts.data[kClustersAtShift + i], 1);
}
