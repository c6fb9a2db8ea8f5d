// Cuts every large triangle into the tiles of 4x4x4 cells that it meets, so that no invocation has a long loop later.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxelize/voxelize_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
LW_PAGED_WRITE(0, 2, VoxelTile, tiles)
layout(set = 0, binding = 3) buffer TileCountBuffer { uint data[]; } tile_counts;
layout(set = 0, binding = 4) readonly buffer GroupBuffer { uint data[]; } groups;

#include "shaders/linear_dispatch.glsl"
#include "passes/voxelize/triangle_cells.glsl"
#include "passes/voxelize/triangle_groups.glsl"

void append_tile(uint triangle, ivec3 tile) {
  uint slot = atomicAdd(tile_counts.data[kTilesFound], 1);
  if (slot < params.tile_capacity) tiles_store(slot, VoxelTile(triangle, tile.x | (tile.y << 10) | (tile.z << 20)));
}

// Tiles along `axis` that the triangle's plane can meet in the column through `tile`: with n the normal and u, v the
// other axes, w = (n.a - n_u u - n_v v) / n_w varies by side / 2 (|n_u| + |n_v|) / |n_w| either way over the column.
ivec2 column_range(CellTriangle t, ivec3 tile, int axis, ivec2 whole) {
  int u = (axis + 1) % 3;
  int v = (axis + 2) % 3;
  if (t.normal[axis] == 0.0) return whole;
  float side = float(kTileSide);
  vec3 center = (vec3(tile) + 0.5) * side;
  vec2 slope = vec2(t.normal[u], t.normal[v]) / t.normal[axis];
  float w = t.a[axis] - slope.x * (center[u] - t.a[u]) - slope.y * (center[v] - t.a[v]);
  float spread = 0.5 * side * (abs(slope.x) + abs(slope.y)) + 0.01;
  return ivec2(max(whole.x, int(floor((w - spread) / side))), min(whole.y, int(floor((w + spread) / side))));
}

void main() {
  uint index = triangle_of_group();
  if (index >= params.triangles.count) return;
  index = chosen_triangle(params.triangles, index);
  CellTriangle t = to_cells(params.grid, load_triangle(index));
  if (cells_in_bounds(t) <= kSmallTriangleCells) return;

  // Columns of tiles along the normal's largest component: each meets the plane in two or three tiles.
  int axis = int(normal_direction(t.normal) / 2);
  int u = (axis + 1) % 3;
  int v = (axis + 2) % 3;
  ivec3 low = t.low / kTileSide;
  ivec3 high = t.high / kTileSide;
  ivec3 tile;
  for (tile[u] = low[u]; tile[u] <= high[u]; ++tile[u]) {
    for (tile[v] = low[v]; tile[v] <= high[v]; ++tile[v]) {
      ivec2 range = column_range(t, tile, axis, ivec2(low[axis], high[axis]));
      for (tile[axis] = range.x; tile[axis] <= range.y; ++tile[axis])
        if (meets_tile(t, tile)) append_tile(index, tile);
    }
  }
}
