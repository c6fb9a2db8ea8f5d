// Every light point's key, with the point's number.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_clusters/light_clusters_params.h"
#include "shaders/light_point.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer PointBuffer { LightPoint data[]; } points;
layout(set = 0, binding = 1) writeonly buffer KeyBuffer { uvec2 data[]; } keys;

#include "shaders/light_point.glsl"
#include "shaders/linear_dispatch.glsl"
#include "shaders/normal_direction.glsl"

// Two zero bits behind each of 4.
uint spread_bits(uint x) {
  x = (x | (x << 4)) & 0x0c3u;
  return (x | (x << 2)) & 0x249u;
}

void main() {
  uint index = linear_invocation();
  if (index >= params.point_count) return;
  LightPoint point = points.data[index];
  uint key = kNoClusterKey;
  if (point.flux != vec3(0.0)) {
    ivec3 cell = clamp(ivec3(floor(grid_coordinates(params.grid, point.position))), ivec3(0), ivec3(kClusterCells - 1));
    key = normal_direction(unpack_unit_vector(point.normal)) << 12 | spread_bits(uint(cell.x)) |
          spread_bits(uint(cell.y)) << 1 | spread_bits(uint(cell.z)) << 2;
  }
  keys.data[index] = uvec2(key, index);
}
