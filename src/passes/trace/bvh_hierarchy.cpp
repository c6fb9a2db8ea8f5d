#include "passes/trace/bvh_hierarchy.h"

#include <string>

#include "passes/trace/bvh_types.h"

namespace lightwell {
namespace {

// A hierarchy that was only refitted gets worse with the way its triangles have gone. What frames with a build cost
// more is spread over so many.
constexpr std::uint32_t kRefitsBeforeBuild = 15;

}  // namespace

BvhHierarchy::Frame BvhHierarchy::record(FrameGraph& graph, const GpuScene::Frame& scene) {
  const Layout layout{scene.triangle_count, scene.moving_first, scene.moving_count};
  const std::uint32_t standing_count = scene.triangle_count - scene.moving_count;
  const std::uint32_t standing_capacity = bvh_node_capacity(standing_count);
  const std::uint32_t moving_capacity = bvh_node_capacity(scene.moving_count);
  const BvhPart standing{standing_count, scene.moving_first, scene.moving_count, 1, 0, 0};
  const BvhPart moving{scene.moving_count, 0, scene.moving_first, 1 + standing_capacity, standing_count, 1};

  bool fresh = false;
  bool any_fresh = false;
  const auto history = [&](const std::string& name, std::uint64_t count, std::uint32_t stride) {
    const BufferHandle handle = graph.history_buffer(name, count, stride, fresh);
    any_fresh |= fresh;
    return handle;
  };
  BvhBuffers buffers;
  buffers.nodes = history("bvh nodes", std::uint64_t{glsl::kBvhNodeWords} * (1 + standing_capacity + moving_capacity),
                          sizeof(glm::uvec4));
  buffers.triangles =
      history("bvh triangles", std::uint64_t{glsl::kBvhTriangleWords} * scene.triangle_count, sizeof(glm::uvec4));
  BufferHandle moving_levels = history("bvh moving levels", glsl::kBvhLevelWords, sizeof(std::uint32_t));
  BufferHandle moving_boxes = history("bvh moving boxes", std::uint64_t{2} * moving_capacity, sizeof(glm::vec4));

  // With the standing triangles the order of all may change.
  const bool all_new =
      any_fresh || !(layout == built_.layout) || scene.revisions.static_geometry != built_.revisions.static_geometry;
  if (all_new) graph.fill("bvh: clear", buffers.nodes, glsl::kBvhNothing);
  if (standing.count > 0 && all_new) {
    buffers.levels = graph.create_buffer("bvh standing levels", glsl::kBvhLevelWords, sizeof(std::uint32_t));
    buffers.node_boxes =
        graph.create_buffer("bvh standing boxes", std::uint64_t{2} * standing_capacity, sizeof(glm::vec4));
    record_bvh_build(graph, scene, standing, buffers);
  }
  buffers.levels = moving_levels;
  buffers.node_boxes = moving_boxes;
  Built built{layout, scene.revisions, built_.refits};
  if (moving.count > 0 && (all_new || built.refits >= kRefitsBeforeBuild)) {
    record_bvh_build(graph, scene, moving, buffers);
    built.refits = 0;
  } else if (moving.count > 0 && scene.revisions.moving_geometry != built_.revisions.moving_geometry) {
    record_bvh_refit(graph, scene, moving, buffers);
    ++built.refits;
  }
  graph.on_recorded([this, built] { built_ = built; });
  return {buffers.nodes, buffers.triangles};
}

}  // namespace lightwell
