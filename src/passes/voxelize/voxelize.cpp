#include "passes/voxelize/voxelize.h"

#include <array>
#include <span>

#include "kernels/passes/voxelize/voxelize_cells.comp.h"
#include "kernels/passes/voxelize/voxelize_finish.comp.h"
#include "kernels/passes/voxelize/voxelize_group_bounds.comp.h"
#include "kernels/passes/voxelize/voxelize_group_list.comp.h"
#include "kernels/passes/voxelize/voxelize_groups.comp.h"
#include "kernels/passes/voxelize/voxelize_tiles.comp.h"
#include "passes/voxelize/voxelize_params.h"

namespace lightwell {
namespace {

// Those that meet the grid.
BufferHandle list_groups(FrameGraph& graph, std::string_view name, const GpuScene::Frame& scene,
                         const glsl::VoxelizeParams& params, BufferHandle bounds) {
  const std::uint32_t count = count_triangle_groups(params.triangles);
  BufferHandle groups =
      graph.create_buffer("voxel triangle groups", glsl::kGroupHeader + std::uint64_t{count}, sizeof(std::uint32_t));
  graph.fill(name, groups, 0);
  dispatch_linear(graph.compute(name, kernels::voxelize_voxelize_groups_comp)
                      .bind(scene.set)
                      .read("group_bounds", bounds)
                      .write("groups", groups)
                      .push(params),
                  count);
  graph.compute(name, kernels::voxelize_voxelize_group_list_comp).write("groups", groups).dispatch(1);
  return groups;
}

}  // namespace

glsl::TriangleChoice all_triangles(const GpuScene::Frame& scene) {
  return {scene.triangle_count, scene.triangle_count, 0};
}

glsl::TriangleChoice standing_triangles(const GpuScene::Frame& scene) {
  return {scene.triangle_count - scene.moving_count, scene.moving_first, scene.moving_count};
}

glsl::TriangleChoice moving_triangles(const GpuScene::Frame& scene) {
  return {scene.moving_count, 0, scene.moving_first};
}

std::uint32_t count_triangle_groups(const glsl::TriangleChoice& triangles) {
  return (triangles.count + glsl::kTriangleGroup - 1) / glsl::kTriangleGroup;
}

void record_group_bounds(FrameGraph& graph, const GpuScene::Frame& scene, const glsl::TriangleChoice& triangles,
                         BufferHandle& bounds) {
  dispatch_linear(graph.compute("voxelize: groups", kernels::voxelize_voxelize_group_bounds_comp)
                      .bind(scene.set)
                      .write("group_bounds", bounds)
                      .push(glsl::VoxelizeParams{{}, triangles, 0}),
                  count_triangle_groups(triangles));
}

// Kernels that can read a list bind something in any case.
void read_groups(FrameGraph& graph, ComputePass& pass, BufferHandle groups) {
  constexpr std::array<std::uint32_t, glsl::kGroupHeader> kNone{};
  pass.constant("kGrouped", groups ? 1 : 0)
      .read("groups", groups ? groups : graph.upload("no groups", std::span<const std::uint32_t>(kNone)));
}

TriangleTiles record_triangle_tiles(FrameGraph& graph, std::string_view name, const GpuScene::Frame& scene,
                                    const glsl::TriangleChoice& triangles, const VoxelGrid& grid,
                                    std::uint32_t tile_capacity, BufferHandle group_bounds) {
  const glsl::VoxelizeParams params{grid, triangles, tile_capacity};
  TriangleTiles tiles;
  tiles.triangles = triangles;
  tiles.tiles = graph.create_buffer("voxel tiles", tile_capacity, sizeof(glsl::VoxelTile));
  tiles.counts = graph.create_buffer("voxel tile counts", glsl::kTileCountWords, sizeof(std::uint32_t));
  graph.fill(name, tiles.counts, 0);
  if (group_bounds) tiles.groups = list_groups(graph, name, scene, params, group_bounds);
  ComputePass& pass = graph.compute(name, kernels::voxelize_voxelize_tiles_comp);
  read_groups(graph, pass, tiles.groups);
  pass.bind(scene.set).write("tiles", tiles.tiles).write("tile_counts", tiles.counts).push(params);
  if (tiles.groups) {
    pass.dispatch_indirect(tiles.groups);
  } else {
    dispatch_linear(pass, triangles.count);
  }
  graph.compute(name, kernels::voxelize_voxelize_finish_comp)
      .write("tile_counts", tiles.counts)
      .push(params)
      .dispatch(1);
  return tiles;
}

VoxelizedTriangles record_voxelize(FrameGraph& graph, const GpuScene::Frame& scene,
                                   const glsl::TriangleChoice& triangles, const VoxelGrid& grid,
                                   std::uint32_t tile_capacity, BufferHandle group_bounds) {
  VoxelizedTriangles voxels;
  voxels.cells = graph.create_buffer("voxel cells", grid.cell_count, sizeof(std::uint32_t));
  graph.fill("voxelize: clear", voxels.cells, 0);
  voxels.tiles = record_triangle_tiles(graph, "voxelize: tiles", scene, triangles, grid, tile_capacity, group_bounds);
  const glsl::VoxelizeParams params{grid, triangles, tile_capacity};
  visit_triangles(graph, "voxelize: cells", kernels::voxelize_voxelize_cells_comp, scene, voxels.tiles,
                  [&](ComputePass& pass) {
                    read_groups(graph, pass, voxels.tiles.groups);
                    pass.write("cells", voxels.cells).push(params);
                  });
  return voxels;
}

}  // namespace lightwell
