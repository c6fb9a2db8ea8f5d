// Material voxels by the exact writer: sums of bytes and a count, kMaterialWords a voxel. One word holds 2^24 of them.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/paged_buffer.glsl"
#include "techniques/ray_traced_voxels/paper_types.h"

LW_PAGED_SUMS(0, 0, sums)

void write_material(uint voxel, vec3 color, vec3 normal_code) {
  uint first = kMaterialWords * voxel;
  uvec3 bytes = uvec3(round(clamp(color, 0.0, 1.0) * 255.0));
  uvec3 normal_bytes = uvec3(round(normal_code * 255.0));
  for (uint k = 0; k < 3; ++k) {
    sums_add(first + k, bytes[k]);
    sums_add(first + 3 + k, normal_bytes[k]);
  }
  sums_add(first + 6, 1);
}

#include "techniques/ray_traced_voxels/paper_fragment.glsl"
