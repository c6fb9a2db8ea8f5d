#include "techniques/photon_splatting/best.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "passes/noise_filter/noise_filter.h"

namespace lightwell {
namespace {

// Frames without change after which a picture is steady.
constexpr std::uint32_t kSteadyFrames = 64;

// Neighbours have noise in common, as far as a kernel is wide: closer taps would not lessen it.
constexpr int kFilterSteps[] = {4, 4, 8, 8};
constexpr NoiseFilterSettings kSplatFilter{kFilterSteps, true, true};

}  // namespace

void PhotonSplattingBest::describe(OptionVisitor& visitor) {
  describe_photon_options(visitor, options_.photons);
  describe_splat_view(visitor, options_.view);
  constexpr std::array<std::string_view, 3> kSides{"1", "2", "4"};
  visitor.visit({"sampling",
                 "In each frame light is gathered at one pixel of a square of this side, by turns, and spread to the "
                 "others on its surface.",
                 "pixels", "1: time; more: light across edges and small things arrives later"},
                options_.view.sampling, kSides);
  visitor.visit({"history", "Frames that a pixel's mean counts at most; 0: each frame by itself.", "", ""},
                options_.history, 0, 100000);
  visitor.visit({"filter", "Smooth what noise is left.", "", "eight readings of the picture"}, options_.filter);
}

GiResult PhotonSplattingBest::record_view(FrameGraph& graph, TechniqueWorld* world_part, ViewFrame& view) {
  auto& world = *static_cast<PhotonWorld*>(world_part);
  still_frames_.note(view);
  const SplatPicture picture =
      record_splat_picture(graph, view, world, options_.view, {.estimate = SplatEstimate::kDensity}, warned_);
  world.vote(graph, picture.screen, picture.splats);
  TemporalBlend blend = still_frames_.blend();
  blend.weighted = options_.view.sampling > 0;
  blend.most_frames = std::min(blend.most_frames, static_cast<float>(options_.history));
  const TemporalMean mean = record_temporal_mean(graph, "indirect light", picture.light, view.reprojection(), blend);
  if (!mean.has_history) still_frames_.note_no_history();
  const ImageHandle irradiance =
      options_.filter ? record_noise_filter(graph, "indirect light", mean, view.gbuffer, view.camera, kSplatFilter)
                      : mean.mean;
  views_ = {{"accumulation", picture.light}, {"normalised", mean.mean}};
  add_splat_views(graph, view, world, options_.view, picture, views_);
  const bool every_frame_alike = options_.photons.same_photons && options_.view.sampling == 0;
  return {.irradiance = irradiance,
          .steady = options_.history == 0 || every_frame_alike || still_frames_.steady() + 1 >= kSteadyFrames};
}

}  // namespace lightwell
