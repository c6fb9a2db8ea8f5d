// Material voxels from the sums of the exact writer.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/paged_buffer.glsl"
#include "techniques/ray_traced_voxels/paper_types.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(VoxelMaterialsParams, LW_VOXEL_MATERIALS_PARAMS)

#include "shaders/linear_dispatch.glsl"

LW_PAGED_READ(0, 0, uint, sums)
layout(set = 0, binding = 1) writeonly buffer AlbedoBuffer { uint data[]; } albedo;
layout(set = 0, binding = 2) writeonly buffer NormalBuffer { uint data[]; } normals;

uint pack_mean(uint first, uint count) {
  vec3 sum = vec3(sums_at(first), sums_at(first + 1), sums_at(first + 2));
  return packUnorm4x8(vec4(sum / (255.0 * float(max(count, 1u))), float(min(count, 255u)) / 255.0));
}

void main() {
  uint voxel = linear_invocation();
  if (voxel >= params.cell_count) return;
  uint first = kMaterialWords * voxel;
  uint count = sums_at(first + 6);
  albedo.data[voxel] = count == 0 ? 0 : pack_mean(first, count);
  normals.data[voxel] = count == 0 ? 0 : pack_mean(first + 3, count);
}
