// The frame: a straight line of passes whose handles are the data flow.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "lightwell/renderer.h"
#include "passes/camera/camera.h"
#include "passes/combine/combine.h"
#include "passes/environment/gpu_environment.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/lights/light_table.h"
#include "passes/reprojection/reprojection.h"
#include "passes/sampled_lights/sampled_lights.h"
#include "passes/shadow_maps/shadow_maps.h"
#include "passes/trace/tracer.h"
#include "shaders/camera.h"
#include "techniques/technique.h"

namespace lightwell {

// What a declared frame holds, before anything is made of it.
struct DeclaredFrame {
  GBuffer gbuffer;
  LightParts parts;
  bool steady = true;
  std::vector<DebugView> views;
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  std::uint64_t lights = 0;
};

class FrameBuilder {
 public:
  // Throws InputError as Renderer's constructor does.
  FrameBuilder(Device& device, const Scene& scene, const SceneSnapshot& snapshot, const RendererOptions& options);
  ~FrameBuilder();

  // Direct light of all sources, as the options want it.
  ImageHandle declare_direct(FrameGraph& graph, const FrameInputs& inputs, const glsl::GpuCamera& camera,
                             DeclaredFrame& frame);

  // Scene -> hierarchy for rays -> shadow maps -> G-buffer -> direct light -> technique.
  DeclaredFrame declare(FrameGraph& graph, const FrameView& view, const PixelSample& sample);

 private:
  GpuScene scene_;
  GpuEnvironment environment_;
  std::unique_ptr<Technique> technique_;  // null: direct light only
  bool shadow_rays_;
  SampledLights::Settings light_settings_;
  bool has_sampled_light_;
  Tracer tracer_;
  LightTable lights_;
  ShadowMaps shadow_maps_;
  SampledLights sampled_lights_;
  std::uint32_t width_;
  std::uint32_t height_;
  std::uint32_t shadow_map_size_;
  std::optional<Bounds> grid_bounds_;
  std::optional<glsl::GpuCamera> last_camera_;
  std::uint64_t frame_index_ = 0;
};

}  // namespace lightwell
