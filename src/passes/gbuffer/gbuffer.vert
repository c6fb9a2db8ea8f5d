// World-space vertices to the screen.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/gbuffer_params.h"
#include "shaders/camera.h"
#include "shaders/geometry.glsl"

LW_PAGED_READ(0, 1, vec4, previous_positions)
#include "shaders/paged_buffer.glsl"

layout(set = 0, binding = 2) uniform Camera { LW_GPU_CAMERA(LW_DECLARE_MEMBER) } camera;

// Alpha-masked triangles are drawn by themselves, without an index buffer: the tests of the others stay early.
layout(constant_id = 0) const uint kAlphaMasked = 0;

layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec4 out_uv;
layout(location = 3) out vec3 out_previous;  // clip x, y, w of last frame
layout(location = 4) flat out uint out_material;
layout(location = 5) flat out float out_handedness;
layout(location = 6) out vec4 out_color;

void main() {
  uint index = kAlphaMasked != 0 ? scene_index(params.first_index + gl_VertexIndex) : gl_VertexIndex;
  WorldVertex v = scene_vertex(index);
  out_position = v.position_material.xyz;
  out_normal = v.normal_u.xyz;
  out_uv = vertex_uv(v);
  out_material = vertex_material(v);
  out_handedness = vertex_handedness(v);
  out_color = vertex_color(v);
  out_previous = (camera.previous_view_projection * vec4(previous_positions_at(index).xyz, 1.0)).xyw;
  gl_Position = camera.view_projection * vec4(out_position, 1.0);
}
