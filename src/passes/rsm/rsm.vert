// World-space vertices to one view of a light, with what their surfaces need.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/rsm/rsm_params.h"
#include "shaders/geometry.glsl"
#include "shaders/shadow_view.glsl"

layout(set = 0, binding = 0) readonly buffer ShadowViewBuffer { ShadowView data[]; } views;

// Alpha-masked triangles are drawn by themselves, without an index buffer: the tests of the others stay early.
layout(constant_id = 0) const uint kAlphaMasked = 0;

layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec4 out_uv;
layout(location = 3) flat out uint out_material;
layout(location = 4) out vec4 out_color;

void main() {
  WorldVertex v = scene_vertex(kAlphaMasked != 0 ? scene_index(gl_VertexIndex) : gl_VertexIndex);
  out_position = vertex_position(v);
  out_normal = vertex_normal(v);
  out_uv = vertex_uv(v);
  out_color = vertex_color(v);
  out_material = vertex_material(v);
  gl_Position = shadow_clip(views.data[params.light], params.face, out_position);
}
