// The same away from the screen.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/paged_buffer.glsl"
#include "shaders/surface_point.h"
#include "techniques/ray_traced_voxels/paper_types.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(VoxelFinalParams, LW_VOXEL_FINAL_PARAMS)

#include "shaders/linear_dispatch.glsl"

layout(set = 0, binding = 0) readonly buffer PointBuffer { SurfacePoint data[]; } points;
LW_PAGED_READ(0, 1, uint, irradiance)
layout(set = 0, binding = 2) writeonly buffer ResultBuffer { vec4 data[]; } result;

#include "techniques/ray_traced_voxels/paper_lookup.glsl"

void main() {
  uint index = linear_invocation();
  if (index >= params.size.x) return;
  vec4 place = points.data[index].position;
  vec3 e = vec3(0.0);
  if (place.w > 0.0) e = look_up(params.grid, place.xyz, params.range) + params.ambient;
  result.data[index] = vec4(e, 1.0);
}
