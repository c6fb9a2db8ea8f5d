#include "passes/voxel_faces/voxel_faces.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "core/log.h"
#include "kernels/passes/voxel_faces/faces_add_areas.comp.h"
#include "kernels/passes/voxel_faces/faces_before.comp.h"
#include "kernels/passes/voxel_faces/faces_cells.comp.h"
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

std::uint32_t most_capacity(const VoxelFaceSettings& settings) {
  return settings.capacity > 0 ? std::min(settings.capacity, glsl::kFaceCapacityLimit) : glsl::kFaceCapacityLimit;
}

// Room for what the last frames had, and half as much to spare, so that it seldom changes. At first for eight closed
// boxes with a layer of faces on either side of their walls, and two in each finer level.
std::uint32_t choose_capacity(const VoxelFaceSettings& settings, const VoxelLevels& levels, FaceRoom& room) {
  const std::uint64_t side = settings.levels.resolution;
  if (room.capacity == 0) room.capacity = (48 + 12 * std::uint64_t{levels.count - 1}) * side * side;
  if (room.found > room.capacity) room.capacity = std::uint64_t{room.found} + room.found / 2;
  return static_cast<std::uint32_t>(
      std::min({room.capacity, 6 * std::uint64_t{count_cells(levels)}, std::uint64_t{most_capacity(settings)}}));
}

bool show_same_cells(const VoxelLevels& a, const VoxelLevels& b) {
  for (std::uint32_t level = 0; level < a.count; ++level)
    if (level_lower(a, level) != level_lower(b, level)) return false;
  return true;
}

// A part of a level's window, in cells from its lower corner.
struct CellBox {
  glm::ivec3 lower{0};
  glm::ivec3 size{0};
};

// What a window shows that it did not show when its lower corner was at `before`: a slab an axis. They may overlap.
std::vector<CellBox> find_new_cells(const glm::ivec3& lower, const glm::ivec3& before, std::uint32_t resolution) {
  const auto side = static_cast<int>(resolution);
  std::vector<CellBox> boxes;
  for (int axis = 0; axis < 3; ++axis) {
    const int moved = lower[axis] - before[axis];
    if (moved == 0) continue;
    if (std::abs(moved) >= side) return {{.size = glm::ivec3(side)}};
    CellBox box{.size = glm::ivec3(side)};
    box.size[axis] = std::abs(moved);
    box.lower[axis] = moved > 0 ? side - moved : 0;
    boxes.push_back(box);
  }
  return boxes;
}

// Voxelises triangles in a part of a level; its cells' words go to their places in `cells`.
void record_cells(FrameGraph& graph, const GpuScene::Frame& scene, const glsl::TriangleChoice& triangles,
                  BufferHandle group_bounds, const VoxelLevels& levels, std::uint32_t level, const CellBox& box,
                  BufferHandle& cells) {
  VoxelGrid grid = level_grid(levels, level);
  grid.origin += glm::vec3(box.lower) * grid.cell_size;
  grid.resolution = glm::uvec3(box.size);
  grid.cell_count = grid.resolution.x * grid.resolution.y * grid.resolution.z;
  const VoxelizedTriangles voxels = record_voxelize(graph, scene, triangles, grid, kDefaultTileCapacity, group_bounds);
  dispatch_linear(graph.compute("voxel faces: cells", kernels::voxel_faces_faces_cells_comp)
                      .read("box", voxels.cells)
                      .write("cells", cells)
                      .push(glsl::FaceCellsParams{levels, box.lower, level, grid.resolution}),
                  grid.cell_count);
}

void record_all_cells(FrameGraph& graph, const GpuScene::Frame& scene, const glsl::TriangleChoice& triangles,
                      BufferHandle group_bounds, const VoxelLevels& levels, BufferHandle& cells) {
  const CellBox all{.size = glm::ivec3(static_cast<int>(levels.resolution))};
  for (std::uint32_t level = 0; level < levels.count; ++level)
    record_cells(graph, scene, triangles, group_bounds, levels, level, all, cells);
}

// Where `before` still holds what lay in the windows of last frame.
void record_new_cells(FrameGraph& graph, const GpuScene::Frame& scene, const glsl::TriangleChoice& triangles,
                      BufferHandle group_bounds, const VoxelLevels& levels, const VoxelLevels& before,
                      BufferHandle& cells) {
  for (std::uint32_t level = 0; level < levels.count; ++level)
    for (const CellBox& box : find_new_cells(level_lower(levels, level), level_lower(before, level), levels.resolution))
      record_cells(graph, scene, triangles, group_bounds, levels, level, box, cells);
}

void record_slots(FrameGraph& graph, BufferHandle standing, BufferHandle moving, VoxelFaces& faces) {
  const glsl::VoxelFaceParams params{.levels = faces.levels, .capacity = faces.capacity};
  const std::uint32_t has_moving = moving ? 1 : 0;
  const std::uint32_t blocks = (count_cells(faces.levels) + glsl::kFaceBlock - 1) / glsl::kFaceBlock;
  BufferHandle block_faces = graph.create_buffer("voxel faces of blocks", blocks, kWord);
  dispatch_linear(graph.compute("voxel faces: count", kernels::voxel_faces_faces_count_comp)
                      .constant("kMoving", has_moving)
                      .read("standing", standing)
                      .read("moving", moving ? moving : standing)
                      .write("block_faces", block_faces)
                      .push(params),
                  blocks);
  graph.fill("voxel faces: clear", faces.table, 0);
  const PrefixSums sums = record_prefix_sums(graph, "voxel faces: sum", block_faces, blocks);
  dispatch_linear(graph.compute("voxel faces: slots", kernels::voxel_faces_faces_store_comp)
                      .constant("kMoving", has_moving)
                      .read("standing", standing)
                      .read("moving", moving ? moving : standing)
                      .read("block_faces", block_faces)
                      .read("sums", sums.sums)
                      .read("sum_blocks", sums.blocks)
                      .write("table", faces.table)
                      .write("keys", faces.keys)
                      .write("counts", faces.counts)
                      .push(params),
                  blocks);
}

void record_areas(FrameGraph& graph, const GpuScene::Frame& scene, VoxelFaces& faces) {
  glsl::VoxelFaceParams params{.levels = faces.levels, .capacity = faces.capacity, .triangles = all_triangles(scene)};
  BufferHandle sums = graph.create_buffer("voxel face area sums", faces.capacity, sizeof(glm::uvec2));
  graph.fill("voxel faces: clear", sums, 0);
  for (params.level = 0; params.level < faces.levels.count; ++params.level) {
    const TriangleTiles tiles = record_triangle_tiles(graph, "voxel faces: areas", scene, params.triangles,
                                                      level_grid(faces.levels, params.level), kDefaultTileCapacity);
    visit_triangles(
        graph, "voxel faces: areas", kernels::voxel_faces_faces_add_areas_comp, scene, tiles,
        [&](ComputePass& pass) { pass.read("face_table", faces.table).write("area_sums", sums).push(params); });
  }
  graph.compute("voxel faces: areas", kernels::voxel_faces_faces_finish_areas_comp)
      .read("counts", faces.counts)
      .read("area_sums", sums)
      .write("areas", faces.areas)
      .dispatch_indirect(faces.counts, glsl::kFaceGroups * kWord);
}

BufferHandle record_before(FrameGraph& graph, const VoxelFaces& faces, BufferHandle old_table,
                           const glm::ivec3& old_center) {
  BufferHandle before = graph.create_buffer("voxel faces before", faces.capacity, kWord);
  graph.compute("voxel faces: before", kernels::voxel_faces_faces_before_comp)
      .read("counts", faces.counts)
      .read("keys", faces.keys)
      .read("old_table", old_table)
      .write("before", before)
      .push(glsl::FaceBeforeParams{faces.levels, old_center})
      .dispatch_indirect(faces.counts, glsl::kFaceGroups * kWord);
  return before;
}

// Room grows with need; where it ends, a warning.
void watch_counts(FrameGraph& graph, const VoxelFaces& faces, const VoxelFaceSettings& settings,
                  const VoxelFaceMemory& memory) {
  graph.watch(faces.counts, [state = memory.room, most = most_capacity(settings),
                             resolution = faces.levels.resolution](std::span<const std::byte> bytes) {
    std::memcpy(&state->found, bytes.data() + glsl::kFacesFound * kWord, sizeof(state->found));
    std::memcpy(&state->stored, bytes.data() + glsl::kFacesStored * kWord, sizeof(state->stored));
    if (state->warned || state->found <= most) return;
    state->warned = true;
    log_warning("voxel faces: " + std::to_string(resolution) + "^3 voxels have " + std::to_string(state->found) +
                " faces, and there is room for " + std::to_string(most) + ": the others are left out");
  });
}

// Finds histories, and notices whether one of them is fresh.
class Histories {
 public:
  explicit Histories(FrameGraph& graph) : graph_(graph) {}
  BufferHandle find(std::string_view name, std::uint64_t count, std::uint32_t stride = kWord) {
    bool fresh = false;
    const BufferHandle buffer = graph_.history_buffer(name, count, stride, fresh);
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
                              const glm::vec3& focus, const VoxelFaceSettings& settings, VoxelFaceMemory& memory) {
  VoxelFaces result;
  result.levels = keep_voxel_levels(memory.levels, bounds, focus, settings.levels);
  result.capacity = choose_capacity(settings, result.levels, *memory.room);

  Histories kept(graph);
  const std::uint32_t cells = count_cells(result.levels);
  result.table = kept.find("voxel face table", cells);
  result.counts = kept.find("voxel face counts", glsl::kFaceCountWords);
  // A table of less room than now says where faces were all the same; what is kept a face is made anew.
  const bool grew = memory.capacity != result.capacity;
  Histories kept_by_slot(graph);
  result.keys = kept_by_slot.find("voxel face keys", result.capacity);
  if (settings.areas) result.areas = kept_by_slot.find("voxel face areas", result.capacity);
  Histories standing_kept(graph);
  BufferHandle standing = standing_kept.find("voxel cells of what stands", cells);

  Histories moving_kept(graph);
  BufferHandle moving;
  if (scene.moving_count > 0) moving = moving_kept.find("voxel cells of what moves", cells);

  const bool same_cells = memory.levels && are_same_cells(*memory.levels, result.levels);
  // Only levels that scroll, or are finer than what they hold, need them.
  const bool has_groups = result.levels.count > 1 && scene.triangle_count > scene.moving_count;
  BufferHandle group_bounds;
  if (has_groups)
    group_bounds =
        standing_kept.find("voxel triangle bounds", 2 * std::uint64_t{count_triangle_groups(standing_triangles(scene))},
                           sizeof(glm::vec4));

  result.fresh = kept.fresh() || (kept_by_slot.fresh() && !grew) || !same_cells;
  const bool scrolled = same_cells && !show_same_cells(*memory.levels, result.levels);
  const bool changed = result.fresh || scrolled || grew || geometry_changed(memory.revisions, scene.revisions);
  result.moved = changed && !result.fresh;
  if (!changed) return result;

  BufferHandle old_table;
  if (result.moved) {
    old_table = graph.create_buffer("voxel face table before", cells, kWord);
    graph.copy("voxel faces: keep", result.table, old_table, std::uint64_t{cells} * kWord);
  }
  const StandingTriangles stand{scene.revisions.static_geometry, scene.moving_first, scene.moving_count};
  const bool same_triangles = same_cells && memory.standing == stand;
  const auto bring_up = [&](const glsl::TriangleChoice& triangles, BufferHandle bounds, bool known,
                            BufferHandle& words) {
    if (!known) {
      record_all_cells(graph, scene, triangles, bounds, result.levels, words);
    } else if (scrolled) {
      record_new_cells(graph, scene, triangles, bounds, result.levels, *memory.levels, words);
    }
  };
  const bool knows_standing = same_triangles && !standing_kept.fresh();
  if (!knows_standing && has_groups) record_group_bounds(graph, scene, standing_triangles(scene), group_bounds);
  bring_up(standing_triangles(scene), group_bounds, knows_standing, standing);
  const bool knows_moving =
      same_triangles && !moving_kept.fresh() && memory.revisions.moving_geometry == scene.revisions.moving_geometry;
  if (moving) bring_up(moving_triangles(scene), {}, knows_moving, moving);
  record_slots(graph, standing, moving, result);
  if (result.areas) record_areas(graph, scene, result);
  if (result.moved) result.before = record_before(graph, result, old_table, memory.levels->center);
  watch_counts(graph, result, settings, memory);
  graph.on_recorded([&memory, levels = result.levels, capacity = result.capacity, revisions = scene.revisions, stand] {
    memory.levels = levels;
    memory.capacity = capacity;
    memory.revisions = revisions;
    memory.standing = stand;
  });
  return result;
}

VoxelFaces record_voxel_faces(FrameGraph& graph, WorldFrame& world, const VoxelFaceSettings& settings,
                              VoxelFaceMemory& memory) {
  if (world.is_cut) memory.levels.reset();
  return record_voxel_faces(graph, world.scene, world.grid_bounds, world.focus, settings, memory);
}

}  // namespace lightwell
