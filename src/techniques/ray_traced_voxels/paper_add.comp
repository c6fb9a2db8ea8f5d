// Adds the irradiance of one more light: a writer keeps one mean a voxel, and the means of several lights add up.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "techniques/ray_traced_voxels/paper_types.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(VoxelAddParams, LW_VOXEL_ADD_PARAMS)

#include "shaders/linear_dispatch.glsl"

layout(set = 0, binding = 0) readonly buffer OneBuffer { uint data[]; } one;
layout(set = 0, binding = 1) buffer IrradianceBuffer { uint data[]; } irradiance;

void main() {
  uint voxel = linear_invocation();
  if (voxel >= params.cell_count || one.data[voxel] == 0) return;
  irradiance.data[voxel] = packUnorm4x8(unpackUnorm4x8(irradiance.data[voxel]) + unpackUnorm4x8(one.data[voxel]));
}
