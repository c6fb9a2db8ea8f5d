// Finds the faces of points on surfaces.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxel_faces/testing/face_lookup.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer PointBuffer { SurfacePoint data[]; } points;
layout(set = 0, binding = 1) readonly buffer FaceTableBuffer { uint data[]; } face_table;
layout(set = 0, binding = 2) writeonly buffer SlotBuffer { uint data[]; } slots;

#include "passes/voxel_faces/voxel_faces.glsl"
#include "shaders/linear_dispatch.glsl"

void main() {
  uint i = linear_invocation();
  if (i >= params.count) return;
  uint level;
  slots.data[i] = face_at(params.levels, points.data[i].position.xyz, points.data[i].normal.xyz, 0.0, level);
}
