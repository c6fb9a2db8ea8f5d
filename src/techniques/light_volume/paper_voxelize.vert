// Slices the scene along one axis: looks along it orthographically, one pixel a column of cells.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "passes/gpu_scene/gpu_scene_types.h"
#include "techniques/light_volume/paper_types.h"

layout(constant_id = 0) const uint axis = 0;

LW_PUSH_CONSTANTS(PaperVoxelizeParams, LW_PAPER_VOXELIZE_PARAMS)

layout(set = 0, binding = 0) readonly buffer VertexBuffer { WorldVertex data[]; } vertices;
layout(set = 0, binding = 1) readonly buffer IndexBuffer { uint data[]; } indices;

#include "shaders/geometry.glsl"

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 uv;
layout(location = 3) flat out vec3 front;  // of the triangle, any length
layout(location = 4) flat out uint material;

void main() {
  Triangle triangle = load_triangle(gl_VertexIndex / 3);
  WorldVertex v = triangle.v[gl_VertexIndex % 3];
  position = vertex_position(v);
  normal = vertex_normal(v);
  uv = vertex_uv(v);
  front = front_normal(triangle);
  material = vertex_material(v);

  vec3 unit = grid_coordinates(params.grid, position) / vec3(params.grid.resolution);
  vec3 turned = axis == 0 ? unit.yzx : (axis == 1 ? unit.zxy : unit);
  gl_Position = vec4(turned.xy * 2.0 - 1.0, turned.z, 1.0);
}
