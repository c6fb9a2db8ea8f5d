// Material voxels by the exact writer: sums of bytes and a count. One word holds 2^24 of them, so nothing is carried:
// the colour takes the low words, the normal the high ones.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "techniques/ray_traced_voxels/paper_sums.glsl"

void write_material(uint voxel, vec3 color, vec3 normal_code) {
  uvec3 bytes = uvec3(round(clamp(color, 0.0, 1.0) * 255.0));
  uvec3 normal_bytes = uvec3(round(clamp(normal_code, 0.0, 1.0) * 255.0));
  uvec4 before = exact_add(voxel, uvec4(bytes, 1));
  exact_add_high(voxel, normal_bytes);
  for (uint i = 0; i < LW_ROUNDS_IF(before.a == 0, 1); ++i) touched.data[append_touched(1)] = voxel;
}

#include "techniques/ray_traced_voxels/paper_fragment.glsl"
