// One view of the world: camera, size, a technique with its options, and histories of its own. A frame is a straight
// line of passes whose handles are the data flow.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightwell/renderer.h"
#include "passes/combine/combine.h"
#include "passes/sampled_lights/sampled_lights.h"
#include "passes/view/view_frame.h"
#include "renderer/shared_world.h"
#include "techniques/technique.h"

namespace lightwell {

// What a declared view holds, before a picture is made of it.
struct DeclaredView {
  GBuffer gbuffer;
  LightParts parts;
  bool steady = true;
  float eye_behind = 0.0f;  // m: how much farther than from the camera depths are (ViewFrame)
  std::vector<DebugView> views;
};

class View {
 public:
  // `name`: before the names of its histories, "" where there is no other view. Throws InputError as Renderer's
  // constructor does.
  View(SharedWorld& shared, std::string name, const RendererOptions& options);

  // Camera -> G-buffer -> direct light -> technique. `cut`: the frames before say nothing about this one. Keep the view
  // until the frame was recorded or dropped.
  DeclaredView declare(FrameGraph& graph, WorldFrame& world, const WorldCamera& camera, bool cut,
                       const PixelSample& sample);

  // What its technique keeps of the world, to look up irradiance away from the screen in a frame that was declared.
  // Null where that is nothing. Lives as long as the view.
  TechniqueWorld* technique_world() const { return part_ ? part_->technique.get() : nullptr; }

 private:
  ImageHandle declare_direct(FrameGraph& graph, ViewFrame& view, DeclaredView& declared);
  GiResult declare_technique(FrameGraph& graph, WorldFrame& world, ViewFrame& view);

  std::string name_;
  glm::uvec2 size_;
  bool shadow_rays_;
  std::unique_ptr<Technique> technique_;     // null: direct light only
  LightKinds direct_kinds_;                  // that the frame brings
  std::shared_ptr<SharedWorld::Part> part_;  // null without a technique
  SampledLights sampled_lights_;
  SampledLights::Settings light_settings_;
  std::optional<glsl::GpuCamera> last_camera_;  // of the last recorded frame
};

}  // namespace lightwell
