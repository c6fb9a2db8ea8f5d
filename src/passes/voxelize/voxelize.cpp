#include "passes/voxelize/voxelize.h"

#include "kernels/passes/voxelize/voxelize_cells.comp.h"
#include "kernels/passes/voxelize/voxelize_finish.comp.h"
#include "kernels/passes/voxelize/voxelize_tiles.comp.h"
#include "passes/voxelize/voxelize_params.h"

namespace lightwell {

VoxelizedTriangles record_voxelize(FrameGraph& graph, const GpuScene::Frame& scene, const VoxelGrid& grid,
                                   std::uint32_t tile_capacity) {
  const glsl::VoxelizeParams params{grid, scene.triangle_count, tile_capacity};
  VoxelizedTriangles voxels;
  voxels.cells = graph.create_buffer("voxel cells", grid.cell_count, sizeof(std::uint32_t));
  voxels.tiles = graph.create_buffer("voxel tiles", tile_capacity, sizeof(glsl::VoxelTile));
  voxels.tile_counts = graph.create_buffer("voxel tile counts", glsl::kTileCountWords, sizeof(std::uint32_t));
  graph.fill("voxelize: clear", voxels.cells, 0);
  graph.fill("voxelize: clear", voxels.tile_counts, 0);

  dispatch_linear(graph.compute("voxelize: tiles", kernels::voxelize_voxelize_tiles_comp)
                      .bind(scene.set)
                      .write("tiles", voxels.tiles)
                      .write("tile_counts", voxels.tile_counts)
                      .push(params),
                  scene.triangle_count);
  graph.compute("voxelize: tiles", kernels::voxelize_voxelize_finish_comp)
      .write("tile_counts", voxels.tile_counts)
      .push(params)
      .dispatch(1);

  visit_triangles(graph, "voxelize: cells", kernels::voxelize_voxelize_cells_comp, scene, voxels,
                  [&](ComputePass& pass) { pass.write("cells", voxels.cells).push(params); });
  return voxels;
}

}  // namespace lightwell
