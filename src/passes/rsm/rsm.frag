// What a light's texel sees, and the light that it reflects there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/rsm/rsm_params.h"
#include "shaders/lights.h"
#include "shaders/shadow_view.h"

layout(set = 0, binding = 0) readonly buffer ShadowViewBuffer { ShadowView data[]; } views;
layout(set = 0, binding = 1) readonly buffer LightBuffer { GpuLight data[]; } lights;

#include "shaders/light_point.glsl"
#include "passes/rsm/rsm_view.glsl"
#include "shaders/finite.glsl"
#include "shaders/material.glsl"
#include "shaders/vertex_color.glsl"

layout(constant_id = 0) const uint kAlphaMasked = 0;

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_uv;
layout(location = 3) flat in uint in_material;
layout(location = 4) in vec4 in_color;

layout(location = 0) out vec4 position;
layout(location = 1) out vec4 normal;
layout(location = 2) out vec4 flux;

void main() {
  // Derivatives first: they are undefined after a discard or in divergent code.
  vec4 uv_dx = dFdx(in_uv);
  vec4 uv_dy = dFdy(in_uv);
  vec3 face_normal = cross(dFdx(in_position), dFdy(in_position));

  // Masks from the finest mip, as shadow maps and rays have them.
  GpuMaterial material = scene_material(in_material);
  vec4 color = kVertexColors != 0 ? in_color : vec4(1.0);
  if (kAlphaMasked != 0 && is_hole(material, base_color(material, color, in_uv, vec4(0.0), vec4(0.0)).a)) discard;
  vec3 albedo = cache_albedo(material, base_color(material, color, in_uv, uv_dx, uv_dy));

  // Both normals on the side that the light hits.
  GpuLight light = lights.data[params.light];
  ShadowView view = views.data[params.light];
  vec2 ndc = (gl_FragCoord.xy - vec2(tile_corner(view, params.face))) * (2.0 / float(view.tile_side)) - 1.0;
  vec3 direction = normalize(view_direction(view, light, params.face, ndc));
  if (dot(face_normal, direction) > 0.0) face_normal = -face_normal;
  face_normal = normalize(face_normal);
  float normal_length = length(in_normal);
  vec3 n = normal_length > 1e-6 ? in_normal / normal_length : face_normal;
  if (dot(n, face_normal) < 0.0) n = -n;
  // On flat surfaces the vertices know the triangle's normal better than the differences of rounded positions.
  const float kFlat = 0.99999;
  if (!(dot(n, face_normal) < kFlat)) face_normal = n;

  vec3 from_light = light.position - in_position;
  float in_range = range_fall_off(light.inverse_range, dot(from_light, from_light));
  vec3 reflected = in_range * texel_flux(view, light, params.face, ndc) * albedo * shading_gain(n, face_normal, direction);
  bool valid = is_finite(in_position) && is_finite(face_normal) && is_finite(reflected);
  position = valid ? vec4(in_position, 1.0) : vec4(0.0);
  normal = valid ? vec4(face_normal, 0.0) : vec4(0.0);
  flux = valid ? vec4(reflected, survival_of(albedo)) : vec4(0.0);
}
