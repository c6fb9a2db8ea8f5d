// Material voxels from the sums of the exact writer.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;

layout(set = 0, binding = 0) writeonly buffer AlbedoBuffer { uint data[]; } albedo;
layout(set = 0, binding = 1) writeonly buffer NormalBuffer { uint data[]; } normals;

#include "techniques/ray_traced_voxels/paper_take_sums.glsl"

void main() {
  uint voxel;
  uvec4 colors;
  uvec3 normal_codes;
  if (!take_sums(voxel, colors, normal_codes)) return;
  float scale = 1.0 / (255.0 * float(colors.a));
  float count = float(min(colors.a, 255u)) / 255.0;
  albedo.data[voxel] = packUnorm4x8(vec4(vec3(colors.rgb) * scale, count));
  normals.data[voxel] = packUnorm4x8(vec4(vec3(normal_codes) * scale, count));
}
