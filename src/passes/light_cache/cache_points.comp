// Indirect irradiance at listed points, from the cache.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/surface_point.h"
#include "passes/light_cache/cache_types.h"
#include "shaders/light_point.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer PointBuffer { SurfacePoint data[]; } points;
layout(set = 0, binding = 1) readonly buffer FaceTableBuffer { uint data[]; } face_table;
layout(set = 0, binding = 2) readonly buffer LitBuffer { LitFace data[]; } lit;
layout(set = 0, binding = 3) buffer VoteBuffer { uint data[]; } votes;
layout(set = 0, binding = 4) writeonly buffer IrradianceBuffer { vec4 data[]; } irradiance;
layout(set = 0, binding = 5) readonly buffer KeyBuffer { uint data[]; } keys;

#include "shaders/linear_dispatch.glsl"
#include "passes/light_cache/cache_look_up.glsl"

void main() {
  uint index = linear_invocation();
  if (index >= params.count) return;
  SurfacePoint point = points.data[index];
  vec3 e = vec3(0.0);
  if (point.position.w > 0.0) {
    vec3 normal = normalize(point.normal.xyz);
    e = look_up(point.position.xyz, normal, normal, index ^ params.frame << 16);
  }
  irradiance.data[index] = vec4(e, 1.0);
}
