// The cell of each light point, and how many there are of each bounce.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light_point.h"
#include "shaders/paged_buffer.glsl"
#include "techniques/photon_splatting/photon_types.h"
#include "techniques/photon_splatting/stratify_types.h"

layout(local_size_x = 64) in;
LW_PAGED_READ(0, 0, LightPoint, points)
layout(set = 0, binding = 1) writeonly buffer KeyBuffer { uvec2 data[]; } keys;
layout(set = 0, binding = 2) buffer PointCountBuffer { uint data[]; } point_counts;

#include "shaders/linear_dispatch.glsl"

// Bit i goes to bit 3 i.
uint spread_bits(uint x) {
  x = (x | x << 8) & 0x0000f00fu;
  x = (x | x << 4) & 0x000c30c3u;
  return (x | x << 2) & 0x00249249u;
}

void main() {
  uint index = linear_invocation();
  if (index >= params.point_count) return;
  LightPoint point = points_at(index);
  uint key = params.no_cell;
  if (point.flux != vec3(0.0)) {
    vec3 place = grid_coordinates(params.grid, point.position);
    uvec3 cell = uvec3(clamp(place, vec3(0.0), vec3(params.grid.resolution) - 0.5));
    key = spread_bits(cell.x) | spread_bits(cell.y) << 1 | spread_bits(cell.z) << 2;
    atomicAdd(point_counts.data[kPointsInAll], 1);
    atomicAdd(point_counts.data[kPointsOfBounce + clamp(point.bounces, 1, kPhotonBounces) - 1], 1);
  }
  keys.data[index] = uvec2(key, index);
}
