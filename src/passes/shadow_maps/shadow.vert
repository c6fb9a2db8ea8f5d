// World-space vertices to one view of a light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shadow_maps/shadow_params.h"
#include "shaders/geometry.glsl"
#include "shaders/shadow_view.glsl"

layout(set = 0, binding = 1) readonly buffer LightBuffer { GpuLight data[]; } lights;

void main() {
  gl_Position = shadow_clip(lights.data[params.light], params.face, scene_position(gl_VertexIndex));
}
