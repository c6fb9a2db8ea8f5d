// Answers a list of shadow rays through the octree: 1 where blocked.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_trace.glsl"
#include "passes/svo/testing/svo_rays.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer RayBuffer { SvoRay data[]; } rays;
layout(set = 0, binding = 1) writeonly buffer BlockedBuffer { uint data[]; } blocked;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint i = linear_invocation();
  if (i >= params.count) return;
  blocked.data[i] = svo_restart_blocked(rays.data[i].from.xyz, rays.data[i].to.xyz) ? 1 : 0;
}
