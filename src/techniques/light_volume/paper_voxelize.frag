// One fragment of one slice: the cell at this pixel and depth. Holds the surface's normal and the radiance that it sends
// out under direct light, shadows included; fragments of all slicings meet under MAX. Mavridis et al. 2010, section 3.1.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/lights.h"
#include "shaders/shadow_view.h"
#include "shaders/sh.glsl"
#include "techniques/light_volume/paper_types.h"
#include "techniques/light_volume/paper_voxel.glsl"

layout(constant_id = 0) const uint axis = 0;

LW_PUSH_CONSTANTS(PaperVoxelizeParams, LW_PAPER_VOXELIZE_PARAMS)

layout(set = 0, binding = 0) readonly buffer LightBuffer { GpuLight data[]; } lights;
layout(set = 0, binding = 1) readonly buffer ShadowViewBuffer { ShadowView data[]; } shadow_views;
layout(set = 0, binding = 2) uniform sampler2D shadow_atlas;
layout(set = 0, binding = 3) buffer VoxelBuffer { uint data[]; } voxels;

#include "shaders/direct.glsl"
#include "shaders/material.glsl"
#include "shaders/vertex_color.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 uv;
layout(location = 3) flat in float handedness;
layout(location = 4) flat in uint material;
layout(location = 5) in vec4 vertex_tint;

ivec3 cell_of_fragment() {
  ivec3 limit = ivec3(params.grid.resolution) - 1;
  ivec3 turned = ivec3(gl_FragCoord.xy, 0);
  ivec3 cell = axis == 0 ? turned.zxy : (axis == 1 ? turned.yzx : turned);
  cell[axis] = int(grid_coordinates(params.grid, position)[axis]);
  return clamp(cell, ivec3(0), limit);
}

void put_max(uint first_plane, uint index, vec3 value) {
  for (uint k = 0; k < 3; ++k) {
    atomicMax(voxels.data[(first_plane + k) * params.grid.cell_count + index], floatBitsToUint(max(value[k], 0.0)));
  }
}

// Of the triangle, any length. Steps of a pixel along the two screen axes span its plane; their cross product looks along
// the view, that is away from the side that is seen.
vec3 front_normal() {
  vec3 away = cross(dFdx(position), dFdy(position));
  return gl_FrontFacing == (handedness > 0.0) ? -away : away;
}

void main() {
  GpuMaterial surface = scene_material(material);
  vec4 uv_dx = dFdx(uv);
  vec4 uv_dy = dFdy(uv);
  vec4 tint = kVertexColors != 0 ? vertex_tint : vec4(1.0);
  vec4 color = base_color(surface, tint, uv, uv_dx, uv_dy);
  vec3 front = front_normal();
  if (is_hole(surface, color.a)) discard;

  vec3 shading = dot(normal, normal) > 0.0 ? normalize(normal) : normalize(front);
  if (dot(shading, front) < 0.0) shading = -shading;

  // A cell has one normal, a surface two sides: the cell takes the brighter side, the front where both are dark.
  vec3 reflectance = cache_albedo(surface, color) / kPi;
  vec3 ahead = reflectance * direct_irradiance(position, shading, params.light_count) +
               emitted_radiance(surface, uv, uv_dx, uv_dy, true);
  vec3 behind = reflectance * direct_irradiance(position, -shading, params.light_count) +
                emitted_radiance(surface, uv, uv_dx, uv_dy, false);
  bool turned = dot(behind, vec3(1.0)) > dot(ahead, vec3(1.0));

  uint index = grid_cell_index(params.grid, cell_of_fragment());
  put_max(kPaperNormalPlane, index, paper_encode_normal(turned ? -shading : shading));
  put_max(kPaperRadiancePlane, index, turned ? behind : ahead);
}
