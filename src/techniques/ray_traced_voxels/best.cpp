#include "techniques/ray_traced_voxels/best.h"

#include <algorithm>
#include <array>

#include "kernels/techniques/ray_traced_voxels/cache_change.comp.h"
#include "kernels/techniques/ray_traced_voxels/cache_pixels.comp.h"
#include "passes/noise_filter/light_change.h"
#include "passes/noise_filter/noise_filter.h"

namespace lightwell {
namespace {

// Frames without change after which a picture is steady.
constexpr std::uint32_t kSteadyFrames = 64;

// That a pixel's mean counts for while something changes that its own ray does not see: light that bounces twice or
// more.
constexpr float kMostFramesInChange = 32.0f;

ImageHandle create_irradiance(FrameGraph& graph, const GBuffer& gbuffer) {
  return graph.create_image(
      "cache irradiance", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
}

glsl::CacheParams view_params(const LightCache& cache, const ViewFrame& view) {
  glsl::CacheParams params = cache.params();
  params.size = {view.gbuffer.width, view.gbuffer.height};
  params.clearance = pixel_clearance(view.camera);
  params.turn = change_turn(view.world.index);
  return params;
}

}  // namespace

void RayTracedVoxelsBest::describe(OptionVisitor& visitor) {
  LightCache::describe(visitor, options_.cache);
  constexpr OptionScope kWorld = OptionScope::kWorld;
  constexpr std::array<std::string_view, 2> kInjections{"camera", "light"};
  int inject = static_cast<int>(options_.cache.inject);
  visitor.visit({"inject",
                 "How direct light gets into the voxels: by shadow rays from where the camera's rays end, or by rays "
                 "from the lights.",
                 "", "", kWorld},
                inject, kInjections);
  options_.cache.inject = static_cast<LightInjection>(inject);
  visitor.visit(
      {"light-paths", "Rays from the lights in each frame, with --inject light.", "", "time in proportion", kWorld},
      options_.cache.light_paths, 16, 65536);
  visitor.visit({"cache-history", "Frames that a voxel's direct light counts at most.", "", "", kWorld},
                options_.cache.history, 1, 4096);
  visitor.visit(
      {"rays", "Rays a pixel and frame; 0: pixels read the voxels' light and send none.", "", "time in proportion"},
      options_.rays, 0, 16);
  visitor.visit({"history", "Frames that a pixel's mean counts at most; 0: each frame by itself.", "", ""},
                options_.history, 0, 100000);
  visitor.visit({"filter", "Smooth what noise is left.", "", "eight readings of the picture"}, options_.filter);
}

ImageHandle RayTracedVoxelsBest::record_rays(FrameGraph& graph, LightCache& cache, const ViewFrame& view,
                                             RayEnds& ends) const {
  ImageHandle irradiance = create_irradiance(graph, view.gbuffer);
  glsl::CacheParams params = view_params(cache, view);
  params.count = static_cast<std::uint32_t>(options_.rays);
  ComputePass& pass =
      trace_compute(graph, "ray-traced voxels: pixels", kernels::ray_traced_voxels_cache_pixels_comp, view.world);
  read_direct_sources(cache.inject(pass), cache.sources())
      .read("position", view.gbuffer.position)
      .read("normal", view.gbuffer.normal)
      .read("face", view.gbuffer.face)
      .write("irradiance", irradiance)
      .write("ends_0", ends.first.current)
      .write("ends_1", ends.last.current)
      .constant("kFromLights", cache.from_lights() ? 1 : 0)
      .push(params)
      .dispatch_threads(params.size.x, params.size.y);
  return irradiance;
}

// For how many frames each block's history may count.
ImageHandle RayTracedVoxelsBest::record_limits(FrameGraph& graph, const LightCache& cache, ViewFrame& view,
                                               const RayEnds& ends) const {
  constexpr std::string_view kName = "ray-traced voxels: change";
  const Reprojection& reprojection = view.reprojection();
  glsl::CacheParams params = view_params(cache, view);
  params.frame -= 1;
  params.count = static_cast<std::uint32_t>(options_.rays);
  const glm::uvec2 blocks = change_blocks(params.size);
  ImageHandle change = graph.create_image(
      "light change", {.width = blocks.x, .height = blocks.y, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
  ComputePass& pass = trace_compute(graph, kName, kernels::ray_traced_voxels_cache_change_comp, view.world);
  read_reprojection(read_direct_sources(pass, cache.sources()), reprojection)
      .read("position", view.gbuffer.position)
      .read("last_ends_0", ends.first.previous)
      .read("last_ends_1", ends.last.previous)
      .write("change", change)
      .push(params)
      .dispatch_threads(blocks.x, blocks.y);
  return record_change_limits(graph, kName, change);
}

// Noisy light, its mean over frames, and what is left of the noise filtered.
ImageHandle RayTracedVoxelsBest::record_gathered(FrameGraph& graph, LightCache& cache, ViewFrame& view) {
  const glm::uvec2 blocks = change_blocks({view.gbuffer.width, view.gbuffer.height});
  const ImageDesc desc{.width = blocks.x, .height = blocks.y, .format = VK_FORMAT_R32G32B32A32_UINT};
  RayEnds ends{graph.history_pair("ray ends 0", desc), graph.history_pair("ray ends 1", desc)};
  const ImageHandle sampled = record_rays(graph, cache, view, ends);
  TemporalBlend blend = still_frames_.blend();
  if (still_frames_.changed() && ends.first.valid && !cache.from_lights()) {
    blend = {.most_frames = kMostFramesInChange,
             .limits = record_limits(graph, cache, view, ends),
             .limit_block = glsl::kChangeBlock};
  }
  blend.most_frames = std::min(blend.most_frames, static_cast<float>(options_.history));
  const TemporalMean mean = record_temporal_mean(graph, "indirect light", sampled, view.reprojection(), blend);
  if (!mean.has_history) still_frames_.note_no_history();
  views_ = {{"sampled-indirect", sampled},
            {"mean-indirect", mean.mean},
            {"history-limits", blend.limits ? blend.limits : mean.mean}};
  return options_.filter ? record_noise_filter(graph, "indirect light", mean, view.gbuffer, view.camera, kPathFilter)
                         : mean.mean;
}

GiResult RayTracedVoxelsBest::record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) {
  LightCache& cache = static_cast<RayTracedVoxelsBestWorld*>(world)->cache;
  views_.clear();
  still_frames_.note(view);
  const ImageHandle irradiance =
      options_.rays > 0 ? record_gathered(graph, cache, view) : cache.record_look_up(graph, view);
  views_.push_back({"voxel-direct", cache.record_view(graph, view, false)});
  views_.push_back({"voxel-indirect", cache.record_view(graph, view, true)});
  return {.irradiance = irradiance, .steady = still_frames_.steady() + 1 >= kSteadyFrames};
}

}  // namespace lightwell
