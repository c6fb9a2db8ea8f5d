#include "passes/trace/ray_query_scene.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "gpu/acceleration_structure.h"
#include "gpu/device.h"
#include "graph/linear_dispatch.h"
#include "kernels/passes/trace/ray_query_corners.comp.h"
#include "lightwell/error.h"
#include "passes/trace/ray_query_corners_params.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kUpdatesABuild = 32;
constexpr std::uint32_t kNoGap = 0xffffffffu;

// Adds [first, end), cut where masks begin.
void add_ranges(std::uint32_t first, std::uint32_t end, std::uint32_t opaque_end, std::vector<SceneRange>& ranges) {
  const std::uint32_t cut = std::clamp(opaque_end, first, end);
  if (first < cut) ranges.push_back({first, cut - first, true});
  if (cut < end) ranges.push_back({cut, end - cut, false});
}

std::uint32_t count_triangles(const std::vector<SceneRange>& ranges) {
  std::uint32_t count = 0;
  for (const SceneRange& range : ranges) count += range.count;
  return count;
}

// A bottom level and, after the last recorded frame, what it is built of.
struct BottomLevel {
  std::vector<SceneRange> ranges;
  bool moves = false;
  std::unique_ptr<AccelerationStructure> structure;
  std::optional<SceneRevisions> revisions;  // of its triangles; none: not built yet
  std::uint32_t updates = 0;                // of the tree since it was built

  bool holds(const SceneRevisions& scene) const {
    if (!revisions || revisions->static_geometry != scene.static_geometry) return false;
    return !moves || revisions->moving_geometry == scene.moving_geometry;
  }
  // Whether its tree has the triangles of `scene`, and may be kept where they moved.
  bool can_update(const SceneRevisions& scene) const {
    return moves && revisions && revisions->static_geometry == scene.static_geometry && updates < kUpdatesABuild;
  }
};

BottomLevel make_level(Device& device, std::vector<SceneRange> ranges, bool moves) {
  std::vector<TriangleRange> geometries;
  for (const SceneRange& range : ranges) geometries.push_back({range.count, range.opaque});
  auto structure = std::make_unique<AccelerationStructure>(
      device, moves ? "acceleration structure, moving" : "acceleration structure, standing", geometries, moves);
  return {std::move(ranges), moves, std::move(structure), {}, 0};
}

BufferHandle record_corners(FrameGraph& graph, const GpuScene::Frame& scene, const BottomLevel& level) {
  const std::uint32_t count = count_triangles(level.ranges);
  BufferHandle corners = graph.create_buffer("acceleration structure corners", 9ull * count, sizeof(float));
  glsl::RayQueryCornersParams params{0, count, scene.moving_first, scene.moving_count};
  if (level.moves) params = {scene.moving_first, count, kNoGap, 0};
  dispatch_linear(graph.compute("corners", kernels::trace_ray_query_corners_comp)
                      .bind(scene.set)
                      .write("corners", corners)
                      .push(params),
                  count);
  return corners;
}

}  // namespace

std::vector<SceneRange> list_standing(const GpuScene::Frame& scene) {
  std::vector<SceneRange> ranges;
  add_ranges(0, scene.moving_first, scene.opaque_triangle_count, ranges);
  add_ranges(scene.moving_first + scene.moving_count, scene.triangle_count, scene.opaque_triangle_count, ranges);
  return ranges;
}

std::vector<SceneRange> list_moving(const GpuScene::Frame& scene) {
  std::vector<SceneRange> ranges;
  add_ranges(scene.moving_first, scene.moving_first + scene.moving_count, scene.opaque_triangle_count, ranges);
  return ranges;
}

struct RayQueryScene::State {
  Device& device;
  std::array<std::vector<SceneRange>, 2> ranges;  // standing, moving
  std::vector<BottomLevel> levels;                // those that have triangles
  std::unique_ptr<AccelerationStructure> top_level;
  bool built = false;  // the top level, in a recorded frame

  void fit(const GpuScene::Frame& scene);
  BufferHandle upload_first_triangles(FrameGraph& graph) const;
};

// New structures where other triangles stand or move than before.
void RayQueryScene::State::fit(const GpuScene::Frame& scene) {
  std::array<std::vector<SceneRange>, 2> wanted{list_standing(scene), list_moving(scene)};
  if (top_level && wanted == ranges) return;
  ranges = std::move(wanted);
  built = false;
  levels.clear();
  for (const bool moves : {false, true})
    if (!ranges[moves].empty()) levels.push_back(make_level(device, ranges[moves], moves));
  top_level = std::make_unique<AccelerationStructure>(device, "acceleration structure, scene",
                                                      static_cast<std::uint32_t>(levels.size()));
}

BufferHandle RayQueryScene::State::upload_first_triangles(FrameGraph& graph) const {
  std::array<glsl::uvec4, 2> firsts{};
  for (std::size_t level = 0; level < levels.size(); ++level)
    for (std::size_t i = 0; i < levels[level].ranges.size(); ++i)
      firsts[level][static_cast<int>(i)] = levels[level].ranges[i].first;
  return graph.upload<glsl::uvec4>("first triangles", firsts);
}

RayQueryScene::RayQueryScene(Device& device) : state_(new State{device, {}, {}, {}, false}) {}

RayQueryScene::~RayQueryScene() = default;

RayQueryScene::Frame RayQueryScene::record(FrameGraph& graph, const GpuScene::Frame& scene) {
  State& state = *state_;
  state.fit(scene);
  bool changed = false;
  std::vector<AccelerationStructureHandle> handles;
  for (BottomLevel& level : state.levels) {
    AccelerationStructureHandle& handle = handles.emplace_back(graph.import_acceleration_structure(*level.structure));
    if (level.holds(scene.revisions)) continue;
    const bool update = level.can_update(scene.revisions);
    graph.build(update ? "update acceleration structure" : "build acceleration structure", handle,
                record_corners(graph, scene, level), update);
    graph.on_recorded([&level, update, revisions = scene.revisions] {
      level.revisions = revisions;
      level.updates = update ? level.updates + 1 : 0;
    });
    changed = true;
  }
  Frame frame{graph.import_acceleration_structure(*state.top_level), state.upload_first_triangles(graph)};
  if (changed || !state.built) graph.build("build top level", frame.top_level, handles);
  graph.on_recorded([&state] { state.built = true; });
  return frame;
}

}  // namespace lightwell
