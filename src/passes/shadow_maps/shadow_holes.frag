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
  // The finest mip: holes keep their shape, and the filter of the lookup smooths what is smaller than a texel.
  GpuMaterial material = materials.data[in_material];
  if (is_hole(material, base_color(material, in_uv, vec4(0.0), vec4(0.0)).a)) discard;
}
