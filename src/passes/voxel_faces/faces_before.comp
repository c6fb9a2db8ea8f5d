// Finds the slot that every face had last frame, when the levels' windows may have lain elsewhere.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxel_faces/voxel_faces_params.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(FaceBeforeParams, LW_FACE_BEFORE_PARAMS)
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer KeyBuffer { uint data[]; } keys;
layout(set = 0, binding = 2) readonly buffer OldTableBuffer { uint data[]; } old_table;
layout(set = 0, binding = 3) writeonly buffer BeforeBuffer { uint data[]; } before;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kFacesStored]) return;
  uint key = keys.data[slot];
  bool was_there = is_same_cell(params.levels, params.old_center, key >> 3);
  before.data[slot] = was_there ? face_slot(old_table.data[key >> 3], key & 7u) : kNoFace;
}
