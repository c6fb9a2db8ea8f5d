#include "renderer/frame_builder.h"

#include <algorithm>
#include <span>

#include "passes/direct/direct.h"
#include "renderer/options.h"

namespace lightwell {
namespace {

std::vector<DebugView> frame_views(const GBuffer& gbuffer, const FrameInputs& inputs, const GiResult& gi) {
  std::vector<DebugView> views{
      {"position", gbuffer.position},         {"normal", gbuffer.normal},           {"albedo", gbuffer.albedo},
      {"emission", gbuffer.emission},         {"motion", gbuffer.motion},           {"depth", gbuffer.depth},
      {"shadow-atlas", inputs.shadows.atlas}, {"direct-irradiance", inputs.direct},
  };
  if (gi.irradiance) views.push_back({"indirect-irradiance", gi.irradiance});
  if (gi.specular) views.push_back({"specular", gi.specular});
  return views;
}

SampledLights::Settings make_light_settings(const RendererOptions& options, const Technique* technique) {
  return {.samples = static_cast<std::uint32_t>(options.light_samples),
          .emitters = !technique || !technique->includes_emitters()};
}

}  // namespace

FrameBuilder::FrameBuilder(Device& device, const Scene& scene, const SceneSnapshot& snapshot,
                           const RendererOptions& options)
    : scene_(device, scene, snapshot),
      environment_(device, scene.environment),
      technique_(create_technique(options)),
      shadow_rays_(options.shadows == 1),
      light_settings_(make_light_settings(options, technique_.get())),
      has_sampled_light_(SampledLights::has_light(scene_.emissive_triangle_count(), environment_, light_settings_)),
      tracer_(device, resolve_tracing(device, options.tracing, shadow_rays_ || has_sampled_light_)),
      shadow_maps_(device),
      width_(static_cast<std::uint32_t>(options.width)),
      height_(static_cast<std::uint32_t>(options.height)),
      shadow_map_size_(static_cast<std::uint32_t>(options.shadow_map_size)),
      grid_bounds_(options.grid_bounds) {}

FrameBuilder::~FrameBuilder() = default;

ImageHandle FrameBuilder::declare_direct(FrameGraph& graph, const FrameInputs& inputs, const glsl::GpuCamera& camera,
                                         DeclaredFrame& frame) {
  if (!shadow_rays_ && !has_sampled_light_) return record_direct(graph, inputs.gbuffer, inputs.lights, inputs.shadows);
  const Tracer::Frame tracer = tracer_.record(graph, inputs.scene);
  SampledLights::Frame sampled;
  if (has_sampled_light_) {
    const Reprojection reprojection = record_reprojection(graph, inputs.gbuffer, camera);
    sampled = sampled_lights_.record(graph, inputs.gbuffer, inputs.scene, tracer, reprojection, environment_,
                                     inputs.environment, camera, light_settings_, inputs.reset, inputs.frame_index);
    frame.steady = sampled.steady;
    frame.views = {{"sampled-light", sampled.sampled}, {"sampled-light-mean", sampled.mean}};
  }
  if (!shadow_rays_) return record_direct(graph, inputs.gbuffer, inputs.lights, inputs.shadows, sampled.irradiance);
  return record_direct_rays(graph, inputs.gbuffer, inputs.lights, inputs.scene, tracer, camera, sampled.irradiance);
}

DeclaredFrame FrameBuilder::declare(FrameGraph& graph, const FrameView& view, const PixelSample& sample) {
  const SceneSnapshot& world = *view.snapshot;
  const bool reset = view.cut || !last_camera_;
  const FrameGraph::Scope scope = graph.enter("", reset);
  const glsl::GpuCamera camera =
      make_gpu_camera(view.camera, {width_, height_}, sample, reset ? nullptr : &*last_camera_);
  last_camera_ = camera;

  FrameInputs inputs;
  inputs.world = &world;
  inputs.grid_bounds = grid_bounds_.value_or(world.bounds);
  inputs.frame_index = frame_index_++;
  inputs.reset = reset;
  inputs.camera = graph.upload("camera", std::span(&camera, 1));
  inputs.scene = scene_.record(graph, world);
  inputs.revisions = inputs.scene.revisions;
  inputs.revisions.environment = environment_.revision();
  inputs.environment = environment_.record(graph);
  const bool reads_maps = !shadow_rays_ || technique_;
  inputs.lights = lights_.record(graph, world.lights);
  inputs.shadows = shadow_maps_.record(graph, inputs.scene, inputs.lights, world.bounds, inputs.grid_bounds,
                                       reads_maps ? shadow_map_size_ : 0);
  inputs.gbuffer = record_gbuffer(graph, inputs.scene, inputs.camera, inputs.environment, width_, height_,
                                  environment_.constant_radiance());
  DeclaredFrame frame;
  inputs.direct = declare_direct(graph, inputs, camera, frame);
  inputs.samples_sources = light_settings_.samples > 0;
  const GiResult gi = technique_ ? technique_->record(graph, inputs) : GiResult{};

  frame.gbuffer = inputs.gbuffer;
  frame.parts = {gi.includes_direct ? ImageHandle{} : inputs.direct, gi.irradiance, gi.specular};
  frame.steady = frame.steady && gi.steady;
  const std::vector<DebugView> views = frame_views(inputs.gbuffer, inputs, gi);
  frame.views.insert(frame.views.begin(), views.begin(), views.end());
  if (technique_) {
    const std::span<const DebugView> own = technique_->debug_views();
    frame.views.insert(frame.views.end(), own.begin(), own.end());
  }
  frame.triangles = inputs.scene.triangle_count;
  frame.vertices = inputs.scene.vertex_count;
  frame.lights = inputs.lights.count;
  return frame;
}

}  // namespace lightwell
