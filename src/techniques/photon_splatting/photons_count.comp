// Which light points there are, and how many of each bounce.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light_point.h"
#include "techniques/photon_splatting/photon_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer LightPointBuffer { LightPoint data[]; } points;
layout(set = 0, binding = 1) writeonly buffer FlagBuffer { uint data[]; } flags;
layout(set = 0, binding = 2) buffer PointCountBuffer { uint data[]; } point_counts;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint index = linear_invocation();
  if (index >= params.paths * params.bounces) return;
  bool is_there = points.data[index].flux != vec3(0.0);
  flags.data[index] = is_there ? 1 : 0;
  if (!is_there) return;
  atomicAdd(point_counts.data[kPointsInAll], 1);
  atomicAdd(point_counts.data[kPointsOfBounce + index / params.paths], 1);
}
