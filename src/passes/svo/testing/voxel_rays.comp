// Answers a list of shadow rays through the grid of bits: 1 where blocked.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/testing/svo_rays.h"
#include "passes/svo/voxel_trace.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kBetween = 0;  // 1: between surfaces
layout(set = 0, binding = 0) readonly buffer RayBuffer { SvoRay data[]; } rays;
layout(set = 0, binding = 1) writeonly buffer BlockedBuffer { uint data[]; } blocked;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint i = linear_invocation();
  if (i >= params.count) return;
  SvoRay ray = rays.data[i];
  bool hit = kBetween != 0 ? voxel_blocked_between(ray.from.xyz, ray.from_normal.xyz, ray.to.xyz, ray.to_normal.xyz)
                           : voxel_blocked(ray.from.xyz, ray.to.xyz);
  blocked.data[i] = hit ? 1 : 0;
}
