// A square for each light point that the camera sees.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_paths/light_point_view_params.h"
#include "shaders/camera.h"
#include "shaders/light_point.h"

layout(set = 0, binding = 0) readonly buffer LightPointBuffer { LightPoint data[]; } points;
layout(set = 0, binding = 1) uniform Camera { LW_GPU_CAMERA(LW_DECLARE_MEMBER) } camera;
layout(set = 0, binding = 2) uniform sampler2D surface_position;

layout(location = 0) out vec2 out_place;  // in the disc, [-1,1]^2
layout(location = 1) flat out vec3 out_color;

vec3 bounce_color(uint bounce) {
  float place = clamp(float(bounce - 1) / 3.0, 0.0, 1.0);
  return bounce == 1 ? vec3(1.0) : vec3(1.0, clamp(1.3 - place, 0.0, 1.0), 0.0);
}

void main() {
  LightPoint point = points.data[gl_InstanceIndex];
  vec2 corner = vec2((gl_VertexIndex == 1 || gl_VertexIndex == 2 || gl_VertexIndex == 4) ? 1.0 : -1.0,
                     (gl_VertexIndex >= 2 && gl_VertexIndex != 3) ? 1.0 : -1.0);
  float strongest = max(max(point.flux.r, point.flux.g), point.flux.b);
  out_place = corner;
  out_color = params.by_bounce != 0 ? bounce_color(point.bounces) : point.flux / max(strongest, 1e-30);
  gl_Position = camera.view_projection * vec4(point.position, 1.0);
  // The surface of the pixel in which its centre is; a disc's radius is allowed for.
  vec2 pixel = (gl_Position.xy / gl_Position.w * 0.5 + 0.5) * vec2(camera.size);
  float surface = texelFetch(surface_position, clamp(ivec2(pixel), ivec2(0), ivec2(camera.size) - 1), 0).w;
  float forward = dot(point.position - camera.position, camera.forward);
  float radius = 2.0 * params.radius * camera.tan_half_y * forward / float(camera.size.y);
  bool hidden = surface > 0.0 && forward > surface + radius;
  gl_Position.xy += corner * (2.0 * params.radius * gl_Position.w) / vec2(camera.size);
  if (strongest <= 0.0 || hidden) gl_Position = vec4(0.0, 0.0, -1.0, 1.0);  // outside
}
