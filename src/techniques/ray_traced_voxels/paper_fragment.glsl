// What a fragment of the voxelisation writes: albedo and normal of the surface (Magalhaes 2020, listing 7.6). The
// including kernel declares
//   void write_material(uint voxel, vec3 albedo, vec3 normal_code);   // both in [0,1]
#ifndef LIGHTWELL_RAY_TRACED_VOXELS_PAPER_FRAGMENT_GLSL
#define LIGHTWELL_RAY_TRACED_VOXELS_PAPER_FRAGMENT_GLSL

#include "shaders/finite.glsl"
#include "shaders/material.glsl"
#include "shaders/vertex_color.glsl"
#include "techniques/ray_traced_voxels/paper_voxels.glsl"

LW_PUSH_CONSTANTS(VoxelDrawParams, LW_VOXEL_DRAW_PARAMS)

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 uv;
layout(location = 3) flat in float handedness;
layout(location = 4) flat in uint material;
layout(location = 5) in vec4 vertex_tint;

// Of the triangle, unit. Steps of a pixel along the two screen axes span its plane; their cross product looks along the
// view, that is away from the side that is seen.
vec3 front_normal() {
  vec3 away = normalize(cross(dFdx(position), dFdy(position)));
  return gl_FrontFacing == (handedness > 0.0) ? -away : away;
}

void main() {
  GpuMaterial surface = scene_material(material);
  vec4 tint = kVertexColors != 0 ? vertex_tint : vec4(1.0);
  vec4 color = base_color(surface, tint, uv, dFdx(uv), dFdy(uv));
  vec3 front = front_normal();
  uint voxel = voxel_of(params.grid, position);
  if (is_hole(surface, color.a) || voxel == kNoVoxel) discard;
  vec3 shading = dot(normal, normal) > 0.0 ? normalize(normal) : front;
  if (!is_finite(shading)) discard;
  write_material(voxel, cache_albedo(surface, color), encode_normal(shading));
}

#endif
