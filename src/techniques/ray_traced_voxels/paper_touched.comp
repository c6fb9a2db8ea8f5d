// How many groups go through the list of touched voxels.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "techniques/ray_traced_voxels/paper_types.h"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer TouchedCountBuffer { uint data[]; } touched_count;

#include "shaders/linear_dispatch.glsl"

void main() {
  uvec3 groups = linear_groups((touched_count.data[kTouchedCount] + 63) / 64);
  for (uint i = 0; i < 3; ++i) touched_count.data[kTouchedGroups + i] = groups[i];
}
