// Depth, with the holes of alpha masks.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gpu_scene/gpu_scene_types.h"

layout(set = 0, binding = 2) readonly buffer MaterialBuffer { GpuMaterial data[]; } materials;
layout(set = 0, binding = 3) uniform sampler2DArray textures_0;
layout(set = 0, binding = 4) uniform sampler2DArray textures_1;
layout(set = 0, binding = 5) uniform sampler2DArray textures_2;
layout(set = 0, binding = 6) uniform sampler2DArray textures_3;

#include "shaders/material.glsl"

layout(location = 0) in vec4 in_uv;
layout(location = 1) flat in uint in_material;

void main() {
  vec4 uv_dx = dFdx(in_uv);
  vec4 uv_dy = dFdy(in_uv);
  GpuMaterial material = materials.data[in_material];
  if (material.alpha_cutoff > 0.0 && is_hole(material, base_color(material, in_uv, uv_dx, uv_dy).a)) discard;
}
