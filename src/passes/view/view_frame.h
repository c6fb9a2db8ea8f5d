// One view of the world in one frame: what its passes share.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/ext/vector_uint2.hpp>

#include "graph/frame_graph.h"
#include "passes/camera/camera.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/reprojection/reprojection.h"
#include "passes/world/world.h"

namespace lightwell {

// Histories that passes of a view ask the graph for are the view's own (FrameGraph::enter).
class ViewFrame {
 public:
  // Declares the G-buffer. `previous`: last frame's camera, or null where the view is cut.
  ViewFrame(FrameGraph& graph, WorldFrame& world, glm::uvec2 size, const WorldCamera& camera, const PixelSample& sample,
            const glsl::GpuCamera* previous);
  ViewFrame(const ViewFrame&) = delete;
  ViewFrame& operator=(const ViewFrame&) = delete;

  WorldFrame& world;
  glsl::GpuCamera camera;
  float eye_behind = 0.0f;                         // m; how far the shaders' camera is behind the view's (EyeCamera)
  std::optional<glsl::GpuCamera> previous_camera;  // none: the frames before say nothing about this one
  BufferHandle camera_buffer;                      // glsl::GpuCamera, uniform
  GBuffer gbuffer;

  bool is_cut() const { return !previous_camera; }
  // Where each pixel's surface was last frame; recorded at first use.
  const Reprojection& reprojection();

 private:
  FrameGraph& graph_;
  std::optional<Reprojection> reprojection_;
};

}  // namespace lightwell
