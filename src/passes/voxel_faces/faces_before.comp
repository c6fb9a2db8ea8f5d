// Finds the slot that every face had last frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxel_faces/voxel_faces_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer KeyBuffer { uint data[]; } keys;
layout(set = 0, binding = 2) readonly buffer OldTableBuffer { uint data[]; } old_table;
layout(set = 0, binding = 3) writeonly buffer BeforeBuffer { uint data[]; } before;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kFacesStored]) return;
  uint key = keys.data[slot];
  before.data[slot] = face_slot(old_table.data[key >> 3], key & 7u);
}
