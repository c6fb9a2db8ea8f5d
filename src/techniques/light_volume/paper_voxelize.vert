// Slices the scene along one axis: looks along it orthographically, one pixel a column of cells (Chen and Fang 1998, whose
// slices are drawn one by one between clipping planes; here each fragment finds its own).
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/geometry.glsl"
#include "techniques/light_volume/paper_types.h"

layout(constant_id = 0) const uint axis = 0;

LW_PUSH_CONSTANTS(PaperVoxelizeParams, LW_PAPER_VOXELIZE_PARAMS)

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 uv;
layout(location = 3) flat out float handedness;
layout(location = 4) flat out uint material;
layout(location = 5) out vec4 vertex_tint;

void main() {
  WorldVertex v = scene_vertex(gl_VertexIndex);
  position = v.position_material.xyz;
  normal = v.normal_u.xyz;
  uv = vertex_uv(v);
  handedness = vertex_handedness(v);
  material = vertex_material(v);
  vertex_tint = vertex_color(v);

  vec3 unit = grid_coordinates(params.grid, position) / vec3(params.grid.resolution);
  vec3 turned = axis == 0 ? unit.yzx : (axis == 1 ? unit.zxy : unit);
  gl_Position = vec4(turned.xy * 2.0 - 1.0, turned.z, 1.0);
}
