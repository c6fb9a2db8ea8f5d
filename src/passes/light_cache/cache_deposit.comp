// Light's rays leave the flux that they carry on: radiosity of a face is the sum of flux over its area. (An average would
// be wrong: a place that more rays meet is brighter.) Only the first surface of each path; what follows is gathered.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light_point.h"
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer PointBuffer { LightPoint data[]; } points;
layout(set = 0, binding = 1) readonly buffer FaceTableBuffer { uint data[]; } face_table;
layout(set = 0, binding = 2) readonly buffer AreaBuffer { uint data[]; } areas;
layout(set = 0, binding = 3) buffer InjectedBuffer { uint data[]; } injected;

#include "passes/voxel_faces/voxel_faces.glsl"
#include "shaders/light_point.glsl"
#include "shaders/linear_dispatch.glsl"
#include "passes/light_cache/cache_inject.glsl"

void deposit(uint level, LightPoint point) {
  const float kLeastArea = 1.0 / 16.0;  // of a cell's side squared: slivers would sparkle
  uint face = face_in_level(params.levels, level, point.position, unpack_unit_vector(point.normal));
  if (face == kNoFace) return;
  float side = level_cell_size(params.levels, level);
  float area = max(float(areas.data[face]) / kFaceAreaUnits, kLeastArea) * side * side;
  inject(face, point.flux / area);
}

void main() {
  uint index = linear_invocation();
  if (index >= params.count) return;
  LightPoint point = points.data[index];
  if (point.flux == vec3(0.0)) return;
  // In every level: nobody knows yet from where light will be read.
  for (uint level = level_at(params.levels, point.position, 0.0); level < params.levels.count; ++level)
    deposit(level, point);
}
