// The scene as acceleration structures: host side of shaders/trace_ray_query.glsl.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "graph/frame_graph.h"
#include "passes/gpu_scene/gpu_scene.h"

namespace lightwell {

class Device;

// Triangles [first, first + count) of the scene, all opaque or all with a mask: one geometry of a bottom level.
struct SceneRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  bool opaque = true;
  bool operator==(const SceneRange&) const = default;
};

// The triangles that stand still, or those that move, in order; at most three ranges, none of them empty.
std::vector<SceneRange> list_standing(const GpuScene::Frame& scene);
std::vector<SceneRange> list_moving(const GpuScene::Frame& scene);

// A bottom level of the standing triangles, kept while they stand; one of the moving triangles, updated where they move
// and built again after some updates, as its boxes grow apart from the triangles' order; a top level of both.
class RayQueryScene {
 public:
  struct Frame {
    AccelerationStructureHandle top_level;
    BufferHandle first_triangles;  // uvec4 a bottom level: the scene's triangle that each geometry begins with
  };

  explicit RayQueryScene(Device& device);
  ~RayQueryScene();

  // Throws InputError if the device cannot take so many triangles. Of a frame that is never recorded nothing stays but
  // new structures, still to be built. Keep this until the frame was recorded.
  Frame record(FrameGraph& graph, const GpuScene::Frame& scene);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lightwell
