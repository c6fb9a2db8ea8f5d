// Voxelisation by the rasteriser (Sun 2015, section 4.3.1): each triangle is seen along the axis of its largest
// projection, one pixel a column of cells. The source chooses the axis in a geometry shader; here each vertex reads its
// triangle.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_params.h"
#include "shaders/finite.glsl"
#include "shaders/geometry.glsl"

LW_PUSH_CONSTANTS(SvoBuildParams, LW_SVO_BUILD_PARAMS)

layout(location = 0) out float depth;  // along the axis, cells
layout(location = 1) flat out uint axis;

void main() {
  Triangle t = load_triangle(gl_VertexIndex / 3);
  vec3 a = grid_coordinates(params.grid, vertex_position(t.v[0]));
  vec3 b = grid_coordinates(params.grid, vertex_position(t.v[1]));
  vec3 c = grid_coordinates(params.grid, vertex_position(t.v[2]));
  vec3 size = abs(cross(b - a, c - a));
  axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;

  uint corner = gl_VertexIndex % 3;
  vec3 p = corner == 0 ? a : corner == 1 ? b : c;
  vec3 turned = axis == 0 ? p.yzx : axis == 1 ? p.zxy : p;
  depth = turned.z;
  vec3 unit = turned / vec3(params.grid.resolution);
  gl_Position = vec4(unit.xy * 2.0 - 1.0, unit.z, 1.0);
  // Outside, all three corners, where one of them is no place.
  if (!(is_finite(a) && is_finite(b) && is_finite(c) && is_finite(size))) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
