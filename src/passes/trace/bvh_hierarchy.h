// The scene's bounding volume hierarchy from frame to frame: one of the triangles that stand, one of those that move.
#pragma once

#include <cstdint>

#include "passes/trace/bvh_build.h"

namespace lightwell {

class Device;

class BvhHierarchy {
 public:
  struct Frame {
    BufferHandle nodes;
    BufferHandle triangles;
  };

  // Throws InputError if the scene is too large for the builder or the device. Declares the passes that bring the
  // buffers from the last recorded frame to this frame's vertices. Keep this until the frame was recorded.
  Frame record(FrameGraph& graph, const GpuScene::Frame& scene);

 private:
  struct Layout {
    std::uint32_t triangle_count = 0;
    std::uint32_t moving_first = 0;
    std::uint32_t moving_count = 0;
    bool operator==(const Layout&) const = default;
  };

  // What the buffers hold after the last recorded frame.
  struct Built {
    Layout layout;
    SceneRevisions revisions;
    std::uint32_t refits = 0;  // since the moving triangles' hierarchy was built
  };

  Built built_;
};

}  // namespace lightwell
