// The area of every face, as it was added up.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxel_faces/voxel_faces_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer AreaSumBuffer { uvec2 data[]; } area_sums;
layout(set = 0, binding = 2) writeonly buffer AreaBuffer { uint data[]; } areas;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kFacesStored]) return;
  uvec2 sum = area_sums.data[slot];
  areas.data[slot] = sum.y == 0 ? sum.x : 0xffffffffu;
}
