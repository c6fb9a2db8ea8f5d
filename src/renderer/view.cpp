#include "renderer/view.h"

#include <span>
#include <utility>

#include "passes/direct/direct.h"
#include "renderer/options.h"

namespace lightwell {
namespace {

// Straight from which sources the frame can bring light.
LightKinds offered_kinds(const RendererOptions& options) {
  return options.light_samples > 0 ? LightKinds::kAll - LightKinds::kBounced : LightKinds::kLights;
}

std::vector<DebugView> list_views(const ViewFrame& view, const DeclaredView& declared) {
  const GBuffer& gbuffer = view.gbuffer;
  std::vector<DebugView> views{{"position", gbuffer.position}, {"normal", gbuffer.normal}, {"albedo", gbuffer.albedo},
                               {"emission", gbuffer.emission}, {"motion", gbuffer.motion}, {"depth", gbuffer.depth}};
  const auto add = [&](std::string_view name, ImageHandle image) {
    if (image) views.push_back({name, image});
  };
  add("shadow-atlas", view.world.recorded_shadow_atlas());
  add("direct-irradiance", declared.parts.direct);
  add("indirect-irradiance", declared.parts.indirect);
  add("specular", declared.parts.specular);
  return views;
}

}  // namespace

View::View(SharedWorld& shared, std::string name, const RendererOptions& options)
    : name_(std::move(name)),
      size_(options.width, options.height),
      shadow_rays_(options.shadows == 1),
      technique_(create_technique(options)),
      direct_kinds_(offered_kinds(options)) {
  if (technique_) {
    const LightKinds covered = technique_->covers(direct_kinds_);
    direct_kinds_ = direct_kinds_ - covered;
    part_ = shared.find_part(world_key(options, *technique_, covered), options.technique, *technique_, covered);
  }
  light_settings_ = {.samples = static_cast<std::uint32_t>(options.light_samples), .kinds = direct_kinds_};
}

ImageHandle View::declare_direct(FrameGraph& graph, ViewFrame& view, DeclaredView& declared) {
  const SampledLights::Frame sampled = sampled_lights_.record(graph, view, light_settings_);
  if (sampled.irradiance) {
    declared.steady = sampled.steady;
    declared.views = {{"sampled-light", sampled.sampled}, {"sampled-light-mean", sampled.mean}};
  }
  if (!has(direct_kinds_, LightKinds::kLights)) return sampled.irradiance;
  return shadow_rays_ ? record_direct_rays(graph, view, sampled.irradiance)
                      : record_direct(graph, view, sampled.irradiance);
}

GiResult View::declare_technique(FrameGraph& graph, WorldFrame& world, ViewFrame& view) {
  return technique_ ? technique_->record_view(graph, SharedWorld::record(*part_, graph, world), view) : GiResult{};
}

DeclaredView View::declare(FrameGraph& graph, WorldFrame& world, const WorldCamera& camera, bool cut,
                           const PixelSample& sample) {
  if (cut) last_camera_.reset();
  const FrameGraph::Scope scope = graph.enter(name_, !last_camera_.has_value());
  ViewFrame view(graph, world, size_, camera, sample, last_camera_ ? &*last_camera_ : nullptr);
  graph.on_recorded([this, camera = view.camera] { last_camera_ = camera; });

  DeclaredView declared;
  declared.gbuffer = view.gbuffer;
  declared.eye_behind = view.eye_behind;
  declared.parts.direct = declare_direct(graph, view, declared);
  const GiResult gi = declare_technique(graph, world, view);
  declared.parts.indirect = gi.irradiance;
  declared.parts.specular = gi.specular;
  declared.steady = declared.steady && gi.steady;
  const std::vector<DebugView> views = list_views(view, declared);
  declared.views.insert(declared.views.begin(), views.begin(), views.end());
  if (technique_) {
    const std::span<const DebugView> own = technique_->debug_views();
    declared.views.insert(declared.views.end(), own.begin(), own.end());
  }
  return declared;
}

}  // namespace lightwell
