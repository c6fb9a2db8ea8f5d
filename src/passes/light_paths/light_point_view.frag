// A disc, where no surface is in front of its centre by more than its radius.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_paths/light_point_view_params.h"
#include "shaders/camera.h"

layout(set = 0, binding = 1) uniform Camera { LW_GPU_CAMERA(LW_DECLARE_MEMBER) } camera;
layout(set = 0, binding = 2) uniform sampler2D surface_position;

layout(location = 0) in vec2 in_place;
layout(location = 1) flat in vec3 in_color;
layout(location = 2) flat in float in_distance;

layout(location = 0) out vec4 picture;

void main() {
  float surface = texelFetch(surface_position, ivec2(gl_FragCoord.xy), 0).w;
  float radius = 2.0 * params.radius * camera.tan_half_y * in_distance / float(camera.size.y);
  if (dot(in_place, in_place) > 1.0 || (surface > 0.0 && in_distance > surface + 2.0 * radius)) discard;
  picture = vec4(in_color, 1.0);
}
