// Material voxels by a published writer.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "techniques/ray_traced_voxels/voxel_write.glsl"

layout(set = 0, binding = 0) buffer AlbedoBuffer { uint data[]; } albedo;
layout(set = 0, binding = 1) buffer NormalBuffer { uint data[]; } normals;

LW_VOXEL_WRITER(albedo)
LW_VOXEL_WRITER(normals)

void write_material(uint voxel, vec3 color, vec3 normal_code) {
  write_albedo(voxel, color);
  write_normals(voxel, normal_code);
}

#include "techniques/ray_traced_voxels/paper_fragment.glsl"
