// Traces a list of rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/trace_rays_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer RayBuffer { ListedRay data[]; } rays;
layout(set = 0, binding = 1) writeonly buffer HitBuffer { ListedHit data[]; } hits;

#include "shaders/linear_dispatch.glsl"
#include "shaders/trace.glsl"

void main() {
  uint index = linear_invocation();
  if (index >= params.ray_count) return;
  ListedRay listed = rays.data[index];
  Ray ray = Ray(listed.origin, listed.t_min, listed.direction, listed.t_max);
  if (params.any_hit != 0) {
    hits.data[index] = ListedHit(0.0, is_blocked(ray) ? 0 : kNoTriangle, vec2(0.0));
  } else {
    RayHit hit = trace_closest(ray);
    hits.data[index] = ListedHit(hit.t, hit.triangle, hit.barycentrics);
  }
}
