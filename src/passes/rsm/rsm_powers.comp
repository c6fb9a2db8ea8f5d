// Luminance of the flux that each light's maps reflect.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/rsm/rsm_powers_params.h"
#include "shaders/shadow_view.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer ShadowViewBuffer { ShadowView data[]; } views;
layout(set = 0, binding = 1) uniform sampler2D luminances;
layout(set = 0, binding = 2) writeonly buffer PowerBuffer { float data[]; } powers;

#include "passes/rsm/rsm_view.glsl"

void main() {
  uint light = gl_GlobalInvocationID.x;
  if (light >= params.light_count) return;
  ShadowView view = views.data[light];
  uint faces = view_face_count(view);
  float sum = faces == 0 ? -1.0 : 0.0;
  for (uint face = 0; face < faces; ++face)
    sum += texelFetch(luminances, ivec2(tile_corner(view, face) >> params.top_level), int(params.top_level)).r;
  powers.data[light] = sum;
}
