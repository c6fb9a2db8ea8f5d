// Writes what rays have hit into the irradiance grid, by a published writer. One invocation a hit.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "techniques/ray_traced_voxels/voxel_write.glsl"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(VoxelWriteParams, LW_VOXEL_WRITE_PARAMS)

#include "shaders/linear_dispatch.glsl"

layout(set = 0, binding = 0) readonly buffer HitBuffer { VoxelHit data[]; } hits;
layout(set = 0, binding = 1) buffer IrradianceBuffer { uint data[]; } irradiance;

LW_VOXEL_WRITER(irradiance)

void main() {
  uint index = linear_invocation();
  if (index >= params.hit_count) return;
  VoxelHit hit = hits.data[index];
  if (hit.voxel != kNoVoxel) write_irradiance(hit.voxel, hit.irradiance / params.range);
}
