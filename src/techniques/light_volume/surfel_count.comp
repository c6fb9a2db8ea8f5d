// The number of surfels in use, as arguments of the dispatches over all of them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/linear_dispatch.glsl"
#include "techniques/light_volume/surfel_types.h"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer CountBuffer { uint data[]; } counts;

void main() {
  uint count = min(counts.data[kCountSurfels], params.capacity - counts.data[kCountUnused]);
  counts.data[kCountSurfels] = count;
  uvec3 groups = linear_groups((count + 63) / 64);
  for (uint i = 0; i < 3; ++i) counts.data[kCountGroups + i] = groups[i];
}
