// Shadow maps of all lights, in one atlas.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "graph/frame_graph.h"
#include "lightwell/scene.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "shaders/lights.h"

namespace lightwell {

class ShadowMaps {
 public:
  struct Frame {
    BufferHandle lights;  // glsl::GpuLight
    std::uint32_t light_count = 0;
    ImageHandle atlas;  // D32, see shaders/shadow.glsl
  };

  // Draws the shadow maps, or keeps last frame's where neither a light nor a triangle has changed since. `focus`: what
  // directional lights must cover; `tile_side`: texels a view (light_views.h), 0: without shadow maps.
  Frame record(FrameGraph& graph, const GpuScene::Frame& scene, const SceneSnapshot& world, const Bounds& focus,
               std::uint32_t tile_side);

 private:
  std::vector<glsl::GpuLight> drawn_lights_;
  SceneRevisions drawn_revisions_;
};

}  // namespace lightwell
