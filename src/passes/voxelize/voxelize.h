// Conservative voxelisation in compute: which cells of a grid do the scene's triangles meet, and which way do they
// face there. Exact up to rounding: a cell is occupied if a triangle meets the closed cell grown by 5e-5 of its side.
//
// No rasterisation: no cell is missed, all directions are handled alike, triangles without an area count too. Small
// triangles loop over the few cells of their bounds; large ones are first cut into tiles of 4x4x4 cells, so that a
// wall keeps as many invocations busy as a crowd of small triangles. Triangles with a corner that is NaN/Inf meet
// nothing.
#pragma once

#include "graph/frame_graph.h"
#include "graph/linear_dispatch.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/voxel_grid/voxel_grid.h"
#include "passes/voxelize/voxelize_types.h"

namespace lightwell {

// Which triangles: all of them, those that stand, or those of the moving range of GpuScene::Frame.
glsl::TriangleChoice all_triangles(const GpuScene::Frame& scene);
glsl::TriangleChoice standing_triangles(const GpuScene::Frame& scene);
glsl::TriangleChoice moving_triangles(const GpuScene::Frame& scene);

// The large ones of some triangles of a scene, cut.
struct TriangleTiles {
  glsl::TriangleChoice triangles{};  // the large ones are cut
  BufferHandle tiles;                // glsl::VoxelTile
  BufferHandle counts;               // words as in voxelize_types.h
  BufferHandle groups;               // the groups of triangles that meet the grid, as listed; none: all are asked
};

struct VoxelizedTriangles {
  BufferHandle cells;  // uint a cell, bits as in voxelize_types.h
  TriangleTiles tiles;
};

inline constexpr std::uint32_t kDefaultTileCapacity = 1u << 19;

// Bounds of every kTriangleGroup of the chosen triangles, two vec4 each: with them, what is all outside of a grid costs
// little. As many as count_triangle_groups(), in a buffer of the caller's.
std::uint32_t count_triangle_groups(const glsl::TriangleChoice& triangles);
void record_group_bounds(FrameGraph& graph, const GpuScene::Frame& scene, const glsl::TriangleChoice& triangles,
                         BufferHandle& bounds);

// What visit_triangles() needs. `tile_capacity`: beyond it large triangles take a slower way. `group_bounds`: of the
// triangles, or none; with them, kernels visit with triangle_groups.glsl, and read_groups().
TriangleTiles record_triangle_tiles(FrameGraph& graph, std::string_view name, const GpuScene::Frame& scene,
                                    const glsl::TriangleChoice& triangles, const VoxelGrid& grid,
                                    std::uint32_t tile_capacity, BufferHandle group_bounds = {});

// What triangle_groups.glsl declares.
void read_groups(FrameGraph& graph, ComputePass& pass, BufferHandle groups);

// Of the chosen triangles of `scene` inside the grid.
VoxelizedTriangles record_voxelize(FrameGraph& graph, const GpuScene::Frame& scene,
                                   const glsl::TriangleChoice& triangles, const VoxelGrid& grid,
                                   std::uint32_t tile_capacity = kDefaultTileCapacity, BufferHandle group_bounds = {});

// Of all triangles.
inline VoxelizedTriangles record_voxelize(FrameGraph& graph, const GpuScene::Frame& scene, const VoxelGrid& grid,
                                          std::uint32_t tile_capacity = kDefaultTileCapacity) {
  return record_voxelize(graph, scene, all_triangles(scene), grid, tile_capacity);
}

// Runs a kernel built on visit_triangles.glsl over every pair of a triangle, of those that the tiles were made of, and
// a cell that it meets. `declare(pass)` binds what the kernel needs beyond the scene and tiles, parameters included.
template <class Declare>
void visit_triangles(FrameGraph& graph, std::string_view name, const KernelCode& kernel, const GpuScene::Frame& scene,
                     const TriangleTiles& tiles, Declare&& declare) {
  for (const std::uint32_t visit : {glsl::kVisitSmallTriangles, glsl::kVisitTiles, glsl::kVisitLargeTriangles}) {
    ComputePass& pass = graph.compute(name, kernel)
                            .bind(scene.set)
                            .read("tiles", tiles.tiles)
                            .read("tile_counts", tiles.counts)
                            .constant("kVisit", visit);
    declare(pass);
    if (visit == glsl::kVisitSmallTriangles && tiles.groups) {
      pass.dispatch_indirect(tiles.groups);
    } else if (visit == glsl::kVisitSmallTriangles) {
      dispatch_linear(pass, tiles.triangles.count);
    } else {
      const std::uint32_t word = visit == glsl::kVisitTiles ? glsl::kTileGroups : glsl::kLargeGroups;
      pass.dispatch_indirect(tiles.counts, word * sizeof(std::uint32_t));
    }
  }
}

}  // namespace lightwell
