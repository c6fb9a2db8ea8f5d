// Lists the groups of triangles whose bounds meet a grid.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxelize/voxelize_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer GroupBoundsBuffer { vec4 data[]; } group_bounds;
layout(set = 0, binding = 1) buffer GroupBuffer { uint data[]; } groups;

#include "passes/voxelize/triangle_cells.glsl"
#include "shaders/linear_dispatch.glsl"

// Coordinates are rounded as those of corners are, so that nobody is lost.
void main() {
  uint group = linear_invocation();
  if (group * kTriangleGroup >= params.triangles.count) return;
  vec3 low = grid_coordinates(params.grid, group_bounds.data[2 * group].xyz) - kCellGrowth;
  vec3 high = grid_coordinates(params.grid, group_bounds.data[2 * group + 1].xyz) + kCellGrowth;
  if (any(greaterThanEqual(low, vec3(params.grid.resolution))) || any(lessThan(high, vec3(0.0)))) return;
  groups.data[kGroupHeader + atomicAdd(groups.data[kGroupsListed], 1)] = group;
}
