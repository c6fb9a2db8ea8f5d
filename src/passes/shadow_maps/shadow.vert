// World-space vertices to one view of a light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shadow_maps/shadow_params.h"
#include "shaders/geometry.glsl"
#include "shaders/shadow_view.glsl"

layout(set = 0, binding = 0) readonly buffer ShadowViewBuffer { ShadowView data[]; } shadow_views;

void main() {
  gl_Position = shadow_clip(shadow_views.data[params.view], params.face, scene_position(gl_VertexIndex));
}
