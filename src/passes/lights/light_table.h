// Point, spot and directional lights on the GPU. Whoever must know whether a light has changed is told here.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "graph/frame_graph.h"
#include "lightwell/scene.h"

namespace lightwell {

class LightTable {
 public:
  struct Frame {
    BufferHandle lights;  // glsl::GpuLight (shaders/lights.h)
    std::uint32_t count = 0;
    std::uint64_t revision = 0;  // changes when a light is added, removed, or changed in any property
    // One a light, in the order of `lights`; they live until the next record().
    std::span<const WorldLight> world;
    std::span<const std::uint64_t> revisions;  // value of `revision` when the light last changed
  };

  // Uploads this frame's lights.
  Frame record(FrameGraph& graph, std::span<const WorldLight> lights);

 private:
  void notice_changes(std::span<const WorldLight> lights);

  std::vector<WorldLight> lights_;
  std::vector<std::uint64_t> revisions_;
  std::uint64_t revision_ = 0;
};

}  // namespace lightwell
