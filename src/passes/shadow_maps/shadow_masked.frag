// Depth of alpha-masked triangles.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/material.glsl"
#include "shaders/vertex_color.glsl"

layout(location = 0) in vec4 in_uv;
layout(location = 1) flat in uint in_material;
layout(location = 2) in vec4 in_color;

void main() {
  // The finest mip: masks keep their shape, and the filter of the lookup smooths what is smaller than a texel.
  GpuMaterial material = scene_material(in_material);
  vec4 color = kVertexColors != 0 ? in_color : vec4(1.0);
  if (is_hole(material, base_color(material, color, in_uv, vec4(0.0), vec4(0.0)).a)) discard;
}
