// What is visible in each pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/camera.h"

layout(set = 0, binding = 2) uniform Camera { LW_GPU_CAMERA(LW_DECLARE_MEMBER) } camera;

#include "shaders/material.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/vertex_color.glsl"

layout(constant_id = 0) const uint kAlphaMasked = 0;

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_uv;
layout(location = 3) in vec3 in_previous;
layout(location = 4) flat in uint in_material;
layout(location = 5) flat in float in_handedness;
layout(location = 6) in vec4 in_color;

layout(location = 0) out vec4 position;
layout(location = 1) out vec4 normal;
layout(location = 2) out vec4 albedo;
layout(location = 3) out vec4 emission;
layout(location = 4) out vec2 motion;
layout(location = 5) out vec4 face;

void main() {
  // Derivatives first: they are undefined after a discard or in divergent code.
  vec4 uv_dx = dFdx(in_uv) * camera.footprint;
  vec4 uv_dy = dFdy(in_uv) * camera.footprint;
  vec3 face_normal = cross(dFdx(in_position), dFdy(in_position));

  GpuMaterial material = scene_material(in_material);
  vec4 color = kVertexColors != 0 ? in_color : vec4(1.0);
  vec4 base = base_color(material, color, in_uv, uv_dx, uv_dy);
  if (kAlphaMasked != 0 && is_hole(material, base.a)) discard;

  // The shading normal on the side that the camera sees. The side is the triangle's, not the interpolated normal's.
  vec3 to_camera = camera.position - in_position;
  if (dot(face_normal, to_camera) < 0.0) face_normal = -face_normal;
  face_normal = normalize(face_normal);
  float normal_length = length(in_normal);
  vec3 n = normal_length > 1e-6 ? in_normal / normal_length : face_normal;
  if (dot(n, face_normal) < 0.0) n = -n;
  // On flat surfaces the vertices know the triangle's normal better than the differences of rounded positions.
  const float kFlat = 0.99999;
  if (!(dot(n, face_normal) < kFlat)) face_normal = n;
  bool front = gl_FrontFacing == (in_handedness > 0.0);

  position = vec4(in_position, dot(-to_camera, camera.forward));
  normal = vec4(n, 0.0);
  albedo = vec4(base.rgb, 1.0);
  emission = vec4(emitted_radiance(material, in_uv, uv_dx, uv_dy, front), float(in_material));

  // Both places are those of the unjittered camera.
  vec2 place = gl_FragCoord.xy + camera.jitter;
  vec2 last_place = (in_previous.xy / max(in_previous.z, 1e-6) * 0.5 + 0.5) * vec2(camera.size);
  motion = place - last_place;
  face = vec4(to_octahedron(face_normal), in_previous.z / position.w, 0.0);
}
