#include "passes/voxelize/voxelize.h"

#include "kernels/passes/voxelize/voxelize_cells.comp.h"
#include "kernels/passes/voxelize/voxelize_finish.comp.h"
#include "kernels/passes/voxelize/voxelize_tiles.comp.h"
#include "passes/voxelize/voxelize_params.h"

namespace lightwell {

glsl::TriangleChoice all_triangles(const GpuScene::Frame& scene) {
  return {scene.triangle_count, scene.triangle_count, 0};
}

glsl::TriangleChoice standing_triangles(const GpuScene::Frame& scene) {
  return {scene.triangle_count - scene.moving_count, scene.moving_first, scene.moving_count};
}

glsl::TriangleChoice moving_triangles(const GpuScene::Frame& scene) {
  return {scene.moving_count, 0, scene.moving_first};
}

TriangleTiles record_triangle_tiles(FrameGraph& graph, std::string_view name, const GpuScene::Frame& scene,
                                    const glsl::TriangleChoice& triangles, const VoxelGrid& grid,
                                    std::uint32_t tile_capacity) {
  const glsl::VoxelizeParams params{grid, triangles, tile_capacity};
  TriangleTiles tiles;
  tiles.triangles = triangles;
  tiles.tiles = graph.create_buffer("voxel tiles", tile_capacity, sizeof(glsl::VoxelTile));
  tiles.counts = graph.create_buffer("voxel tile counts", glsl::kTileCountWords, sizeof(std::uint32_t));
  graph.fill(name, tiles.counts, 0);
  dispatch_linear(graph.compute(name, kernels::voxelize_voxelize_tiles_comp)
                      .bind(scene.set)
                      .write("tiles", tiles.tiles)
                      .write("tile_counts", tiles.counts)
                      .push(params),
                  triangles.count);
  graph.compute(name, kernels::voxelize_voxelize_finish_comp)
      .write("tile_counts", tiles.counts)
      .push(params)
      .dispatch(1);
  return tiles;
}

VoxelizedTriangles record_voxelize(FrameGraph& graph, const GpuScene::Frame& scene,
                                   const glsl::TriangleChoice& triangles, const VoxelGrid& grid,
                                   std::uint32_t tile_capacity) {
  VoxelizedTriangles voxels;
  voxels.cells = graph.create_buffer("voxel cells", grid.cell_count, sizeof(std::uint32_t));
  graph.fill("voxelize: clear", voxels.cells, 0);
  voxels.tiles = record_triangle_tiles(graph, "voxelize: tiles", scene, triangles, grid, tile_capacity);
  const glsl::VoxelizeParams params{grid, triangles, tile_capacity};
  visit_triangles(graph, "voxelize: cells", kernels::voxelize_voxelize_cells_comp, scene, voxels.tiles,
                  [&](ComputePass& pass) { pass.write("cells", voxels.cells).push(params); });
  return voxels;
}

}  // namespace lightwell
