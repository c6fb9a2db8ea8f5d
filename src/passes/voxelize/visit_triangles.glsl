// Visits every pair of a triangle and a cell that it meets, once. The including kernel, 64 x 1 x 1 invocations a
// group, declares
//   LW_PAGED_READ(0, n, VoxelTile, tiles)
//   layout(set = 0, binding = n) readonly buffer TileCountBuffer { uint data[]; } tile_counts;
//   void visit_cell(Triangle source, CellTriangle triangle, ivec3 cell);
// before including this file, and, where only listed groups of triangles are visited, defines LW_VISITED_TRIANGLE as
// triangle_of_group (triangle_groups.glsl). It calls visit_triangles() from main(), with the triangles that the tiles were made of. Host
// side: visit_triangles() of voxelize.h.
#ifndef LIGHTWELL_VISIT_TRIANGLES_GLSL
#define LIGHTWELL_VISIT_TRIANGLES_GLSL

#include "shaders/linear_dispatch.glsl"

#ifndef LW_VISITED_TRIANGLE
#define LW_VISITED_TRIANGLE linear_invocation
#endif

layout(constant_id = 0) const uint kVisit = 0;  // kVisitSmallTriangles, kVisitTiles or kVisitLargeTriangles

void visit_bounds(Triangle source, CellTriangle triangle) {
  for (int z = triangle.low.z; z <= triangle.high.z; ++z)
    for (int y = triangle.low.y; y <= triangle.high.y; ++y)
      for (int x = triangle.low.x; x <= triangle.high.x; ++x)
        if (meets_cell(triangle, ivec3(x, y, z))) visit_cell(source, triangle, ivec3(x, y, z));
}

void visit_tile(VoxelGrid grid, VoxelTile tile) {
  Triangle source = load_triangle(tile.triangle);
  CellTriangle triangle = to_cells(grid, source);
  uint local = gl_LocalInvocationID.x;
  ivec3 corner = kTileSide * ivec3(tile.tile & 1023u, (tile.tile >> 10) & 1023u, tile.tile >> 20);
  ivec3 cell = corner + ivec3(local & 3u, (local >> 2) & 3u, local >> 4);
  if (any(lessThan(cell, triangle.low)) || any(greaterThan(cell, triangle.high))) return;
  if (meets_cell(triangle, cell)) visit_cell(source, triangle, cell);
}

void visit_triangles(VoxelGrid grid, TriangleChoice triangles) {
  if (kVisit == kVisitTiles) {
    if (linear_group() < tile_counts.data[kTilesFound]) visit_tile(grid, tiles_at(linear_group()));
    return;
  }
  uint index = LW_VISITED_TRIANGLE();
  if (index >= triangles.count) return;
  Triangle source = load_triangle(chosen_triangle(triangles, index));
  CellTriangle triangle = to_cells(grid, source);
  bool small = cells_in_bounds(triangle) <= kSmallTriangleCells;
  if (small == (kVisit == kVisitSmallTriangles)) visit_bounds(source, triangle);
}

// Of all triangles.
void visit_triangles(VoxelGrid grid, uint triangle_count) {
  visit_triangles(grid, TriangleChoice(triangle_count, triangle_count, 0));
}

#endif
