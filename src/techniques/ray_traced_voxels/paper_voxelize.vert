// The scene seen orthographically along one axis, one pixel a column of voxels (Magalhaes 2020, listing 7.6).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/geometry.glsl"
#include "techniques/ray_traced_voxels/paper_types.h"

layout(constant_id = 0) const uint kAxis = 0;

LW_PUSH_CONSTANTS(VoxelDrawParams, LW_VOXEL_DRAW_PARAMS)

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 uv;
layout(location = 3) flat out float handedness;
layout(location = 4) flat out uint material;
layout(location = 5) out vec4 vertex_tint;

void main() {
  WorldVertex v = scene_vertex(gl_VertexIndex);
  position = vertex_position(v);
  normal = vertex_normal(v);
  uv = vertex_uv(v);
  handedness = vertex_handedness(v);
  material = vertex_material(v);
  vertex_tint = vertex_color(v);

  vec3 unit = grid_coordinates(params.grid, position) / vec3(params.grid.resolution);
  vec3 turned = kAxis == 0 ? unit.yzx : (kAxis == 1 ? unit.zxy : unit);
  gl_Position = vec4(turned.xy * 2.0 - 1.0, turned.z, 1.0);
}
