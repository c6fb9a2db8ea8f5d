// As shadow.vert, for alpha-masked triangles: without an index buffer, with what their alpha needs.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shadow_maps/shadow_params.h"
#include "shaders/geometry.glsl"
#include "shaders/shadow_view.glsl"

layout(set = 0, binding = 0) readonly buffer ShadowViewBuffer { ShadowView data[]; } shadow_views;

layout(location = 0) out vec4 out_uv;
layout(location = 1) flat out uint out_material;
layout(location = 2) out vec4 out_color;

void main() {
  WorldVertex v = scene_vertex(scene_index(gl_VertexIndex));
  out_uv = vertex_uv(v);
  out_material = vertex_material(v);
  out_color = vertex_color(v);
  gl_Position = shadow_clip(shadow_views.data[params.view], params.face, v.position_material.xyz);
}
