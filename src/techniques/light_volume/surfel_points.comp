// Irradiance at listed points.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/surface_point.h"
#include "techniques/light_volume/surfel_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer PointBuffer { SurfacePoint data[]; } points;
layout(set = 0, binding = 1) readonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 2) readonly buffer LitBuffer { LitSurfel data[]; } lit;
layout(set = 0, binding = 3) uniform sampler2D environment;
layout(set = 0, binding = 4) writeonly buffer IrradianceBuffer { vec4 data[]; } irradiance;

#include "shaders/linear_dispatch.glsl"
#include "techniques/light_volume/surfel_lookup.glsl"

// params.size.x: how many points there are.
void main() {
  uint index = linear_invocation();
  if (index >= params.size.x) return;
  SurfacePoint point = points.data[index];
  vec3 e = vec3(0.0);
  if (point.position.w > 0.0) e = look_up(point.position.xyz, normalize(point.normal.xyz));
  irradiance.data[index] = vec4(e, 1.0);
}
