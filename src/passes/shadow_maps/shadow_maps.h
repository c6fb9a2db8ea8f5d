// Shadow maps of all lights, in one atlas.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "graph/frame_graph.h"
#include "lightwell/scene.h"
#include "passes/focus/focus_balls.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/lights/light_table.h"
#include "passes/shadow_maps/atlas_layout.h"
#include "shaders/shadow_view.h"

namespace lightwell {

class Device;

class ShadowMaps {
 public:
  struct Frame {
    BufferHandle views;  // glsl::ShadowView, one a light, then wider ones (shaders/shadow_view.h)
    ImageHandle atlas;   // D32, see shaders/shadow.glsl
  };

  explicit ShadowMaps(const Device& device);

  // Draws those views that see the scene in another way than when they were drawn, or all of them where a triangle has
  // changed since; keeps the others. `bounds`: of the scene; `balls`: what suns see finely; `tile_side`: texels a view
  // (shadow_views.h). Warns once where an atlas of kMaximumAtlasSide, or of what the device offers, is too small for
  // the maps.
  Frame record(FrameGraph& graph, const GpuScene::Frame& scene, const LightTable::Frame& lights, const Bounds& bounds,
               std::span<const FocusBall> balls, std::uint32_t tile_side);

 private:
  void warn(const AtlasLayout& layout);

  std::uint32_t atlas_side_;  // at most, texels
  bool warned_ = false;
  std::vector<glsl::ShadowView> drawn_views_;
  SceneRevisions drawn_revisions_;  // of the scene that they show
};

// Binds what shaders/direct.glsl reads.
template <class SomePass>
SomePass& read_lights(SomePass& pass, const LightTable::Frame& lights, const ShadowMaps::Frame& shadows) {
  return pass.read("lights", lights.lights)
      .read("shadow_views", shadows.views)
      .read("shadow_atlas", shadows.atlas, SamplerKind::kNearestClamp);
}

}  // namespace lightwell
