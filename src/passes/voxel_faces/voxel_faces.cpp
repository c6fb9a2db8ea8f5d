#include "passes/voxel_faces/voxel_faces.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>

#include "core/log.h"
#include "kernels/passes/voxel_faces/faces_add_areas.comp.h"
#include "kernels/passes/voxel_faces/faces_before.comp.h"
#include "kernels/passes/voxel_faces/faces_count.comp.h"
#include "kernels/passes/voxel_faces/faces_finish_areas.comp.h"
#include "kernels/passes/voxel_faces/faces_store.comp.h"
#include "lightwell/error.h"
#include "passes/sort/sort.h"
#include "passes/voxel_faces/voxel_faces_params.h"
#include "passes/voxelize/voxelize.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kWord = sizeof(std::uint32_t);

// 8 times a closed box with one layer of faces on either side of its walls.
std::uint32_t choose_capacity(const VoxelFaceSettings& settings) {
  const std::uint64_t side = settings.resolution;
  const std::uint64_t asked = settings.capacity > 0 ? settings.capacity : 48 * side * side;
  return static_cast<std::uint32_t>(std::min({asked, 6 * side * side * side, std::uint64_t{glsl::kFaceCapacityLimit}}));
}

// Faces of some of the triangles; words of the table as the kernels have them.
struct FaceSet {
  BufferHandle table;
  BufferHandle keys;
  BufferHandle areas;  // none where not asked for
  BufferHandle counts;
};

// One build: of all triangles, of those that stand, or of those that move over those that stand.
struct Build {
  const GpuScene::Frame& scene;
  VoxelGrid grid;
  std::uint32_t capacity = 0;
  glsl::TriangleChoice triangles{};
  bool keep_all = false;              // cells without room keep their directions
  const FaceSet* standing = nullptr;  // faces to which those of the triangles come
};

void record_slots(FrameGraph& graph, const Build& build, BufferHandle cells, FaceSet& faces) {
  const glsl::VoxelFaceParams params{build.grid, build.triangles, build.capacity};
  const BufferHandle standing = build.standing != nullptr ? build.standing->table : cells;
  const std::uint32_t has_standing = build.standing != nullptr ? 1 : 0;
  const std::uint32_t blocks = (build.grid.cell_count + glsl::kFaceBlock - 1) / glsl::kFaceBlock;
  BufferHandle block_faces = graph.create_buffer("voxel faces of blocks", blocks, kWord);
  dispatch_linear(graph.compute("voxel faces: count", kernels::voxel_faces_faces_count_comp)
                      .constant("kStanding", has_standing)
                      .read("standing", standing)
                      .read("cells", cells)
                      .write("block_faces", block_faces)
                      .push(params),
                  blocks);
  graph.fill("voxel faces: clear", faces.table, 0);
  const PrefixSums sums = record_prefix_sums(graph, "voxel faces: sum", block_faces, blocks);
  dispatch_linear(graph.compute("voxel faces: slots", kernels::voxel_faces_faces_store_comp)
                      .constant("kStanding", has_standing)
                      .constant("kKeepAll", build.keep_all ? 1 : 0)
                      .read("standing", standing)
                      .read("cells", cells)
                      .read("block_faces", block_faces)
                      .read("sums", sums.sums)
                      .read("sum_blocks", sums.blocks)
                      .write("table", faces.table)
                      .write("keys", faces.keys)
                      .write("counts", faces.counts)
                      .push(params),
                  blocks);
}

void record_areas(FrameGraph& graph, const Build& build, const TriangleTiles& tiles, FaceSet& faces) {
  const glsl::VoxelFaceParams params{build.grid, build.triangles, build.capacity};
  BufferHandle sums = graph.create_buffer("voxel face area sums", build.capacity, sizeof(glm::uvec2));
  graph.fill("voxel faces: clear", sums, 0);
  visit_triangles(
      graph, "voxel faces: areas", kernels::voxel_faces_faces_add_areas_comp, build.scene, tiles,
      [&](ComputePass& pass) { pass.read("face_table", faces.table).write("area_sums", sums).push(params); });
  const FaceSet& standing = build.standing != nullptr ? *build.standing : faces;
  graph.compute("voxel faces: areas", kernels::voxel_faces_faces_finish_areas_comp)
      .constant("kStanding", build.standing != nullptr ? 1 : 0)
      .read("counts", faces.counts)
      .read("keys", faces.keys)
      .read("area_sums", sums)
      .read("standing", standing.table)
      .read("standing_areas", build.standing != nullptr ? standing.areas : faces.keys)
      .write("areas", faces.areas)
      .push(params)
      .dispatch_indirect(faces.counts, glsl::kFaceGroups * kWord);
}

void record_faces(FrameGraph& graph, const Build& build, FaceSet& faces) {
  const VoxelizedTriangles voxels = record_voxelize(graph, build.scene, build.triangles, build.grid);
  record_slots(graph, build, voxels.cells, faces);
  if (faces.areas) record_areas(graph, build, voxels.tiles, faces);
}

BufferHandle record_before(FrameGraph& graph, const FaceSet& faces, std::uint32_t capacity, BufferHandle old_table) {
  BufferHandle before = graph.create_buffer("voxel faces before", capacity, kWord);
  graph.compute("voxel faces: before", kernels::voxel_faces_faces_before_comp)
      .read("counts", faces.counts)
      .read("keys", faces.keys)
      .read("old_table", old_table)
      .write("before", before)
      .dispatch_indirect(faces.counts, glsl::kFaceGroups * kWord);
  return before;
}

void watch_counts(FrameGraph& graph, const VoxelFaces& faces, const VoxelFaceMemory& memory) {
  graph.watch(faces.counts, [warned = memory.warned, capacity = faces.capacity,
                             resolution = faces.grid.resolution.x](std::span<const std::byte> bytes) {
    std::uint32_t found = 0;
    std::memcpy(&found, bytes.data() + glsl::kFacesFound * kWord, sizeof(found));
    if (*warned || found <= capacity) return;
    *warned = true;
    log_warning("voxel faces: " + std::to_string(resolution) + "^3 voxels have " + std::to_string(found) +
                " faces, and there is room for " + std::to_string(capacity) + ": the others are left out");
  });
}

// Finds histories, and notices whether one of them is fresh.
class Histories {
 public:
  explicit Histories(FrameGraph& graph) : graph_(graph) {}
  BufferHandle find(std::string_view name, std::uint64_t count) {
    bool fresh = false;
    const BufferHandle buffer = graph_.history_buffer(name, count, kWord, fresh);
    fresh_ = fresh_ || fresh;
    return buffer;
  }
  bool fresh() const { return fresh_; }

 private:
  FrameGraph& graph_;
  bool fresh_ = false;
};

}  // namespace

VoxelFaces record_voxel_faces(FrameGraph& graph, const GpuScene::Frame& scene, const Bounds& bounds,
                              const VoxelFaceSettings& settings, VoxelFaceMemory& memory) {
  LW_ASSERT(settings.resolution >= 1 && settings.resolution <= 256,
            "resolution " + std::to_string(settings.resolution));
  VoxelFaces result;
  result.grid = keep_voxel_grid(memory.grid, bounds, settings.resolution);
  result.capacity = choose_capacity(settings);

  Histories kept(graph);
  FaceSet faces;
  faces.table = kept.find("voxel face table", result.grid.cell_count);
  faces.keys = kept.find("voxel face keys", result.capacity);
  faces.counts = kept.find("voxel face counts", glsl::kFaceCountWords);
  if (settings.areas) faces.areas = kept.find("voxel face areas", result.capacity);
  // Asked for in every frame, so that they stay while nothing moves for long.
  Histories standing_kept(graph);
  FaceSet standing;
  const bool apart = scene.moving_count > 0;
  if (apart) {
    standing.table = standing_kept.find("voxel face table of what stands", result.grid.cell_count);
    if (settings.areas) standing.areas = standing_kept.find("voxel face areas of what stands", result.capacity);
  }

  const bool same_grid = memory.grid && is_same_grid(*memory.grid, result.grid);
  result.fresh = kept.fresh() || !same_grid;
  const bool changed = result.fresh || geometry_changed(memory.revisions, scene.revisions);
  result.moved = changed && !result.fresh;
  if (changed) {
    BufferHandle old_table;
    if (result.moved) {
      old_table = graph.create_buffer("voxel face table before", result.grid.cell_count, kWord);
      graph.copy("voxel faces: keep", faces.table, old_table, std::uint64_t{result.grid.cell_count} * kWord);
    }
    Build build{.scene = scene,
                .grid = result.grid,
                .capacity = result.capacity,
                .triangles = all_triangles(scene),
                .keep_all = false,
                .standing = nullptr};
    if (apart) {
      const bool stands =
          same_grid && !standing_kept.fresh() && memory.standing_revision == scene.revisions.static_geometry;
      if (!stands) {
        build.triangles = standing_triangles(scene);
        build.keep_all = true;
        standing.keys = graph.create_buffer("voxel face keys of what stands", result.capacity, kWord);
        standing.counts = graph.create_buffer("voxel face counts of what stands", glsl::kFaceCountWords, kWord);
        record_faces(graph, build, standing);
      }
      build.triangles = moving_triangles(scene);
      build.keep_all = false;
      build.standing = &standing;
    }
    record_faces(graph, build, faces);
    if (result.moved) result.before = record_before(graph, faces, result.capacity, old_table);
  }
  result.table = faces.table;
  result.keys = faces.keys;
  result.areas = faces.areas;
  result.counts = faces.counts;
  if (changed) {
    watch_counts(graph, result, memory);
    graph.on_recorded([&memory, grid = result.grid, revisions = scene.revisions, apart] {
      memory.grid = grid;
      memory.revisions = revisions;
      memory.standing_revision.reset();
      if (apart) memory.standing_revision = revisions.static_geometry;
    });
  }
  return result;
}

VoxelFaces record_voxel_faces(FrameGraph& graph, WorldFrame& world, const VoxelFaceSettings& settings,
                              VoxelFaceMemory& memory) {
  if (world.is_cut) memory.grid.reset();
  return record_voxel_faces(graph, world.scene, world.grid_bounds, settings, memory);
}

}  // namespace lightwell
