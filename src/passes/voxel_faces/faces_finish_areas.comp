// The area of every face: what was added up, and that of what stands.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxel_faces/voxel_faces_params.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kStanding = 0;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer KeyBuffer { uint data[]; } keys;
layout(set = 0, binding = 2) readonly buffer AreaSumBuffer { uvec2 data[]; } area_sums;
layout(set = 0, binding = 3) readonly buffer StandingBuffer { uint data[]; } standing;
layout(set = 0, binding = 4) readonly buffer StandingAreaBuffer { uint data[]; } standing_areas;
layout(set = 0, binding = 5) writeonly buffer AreaBuffer { uint data[]; } areas;

#include "shaders/linear_dispatch.glsl"

const uint kMost = 0xffffffffu;

uint standing_area(uint key) {
  uint slot = face_slot(standing.data[key >> 3], key & 7u);
  return slot < params.capacity ? standing_areas.data[slot] : 0;
}

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kFacesStored]) return;
  uvec2 sum = area_sums.data[slot];
  uint area = sum.y == 0 ? sum.x : kMost;
  if (kStanding == 1) {
    uint other = standing_area(keys.data[slot]);
    area = other > kMost - area ? kMost : area + other;
  }
  areas.data[slot] = area;
}
