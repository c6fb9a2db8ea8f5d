#include "techniques/photon_splatting/best.h"

#include <algorithm>

#include "passes/noise_filter/noise_filter.h"

namespace lightwell {
namespace {

// Frames without change after which a picture is steady.
constexpr std::uint32_t kSteadyFrames = 64;

}  // namespace

void PhotonSplattingBest::describe(OptionVisitor& visitor) {
  describe_photon_options(visitor, options_.photons);
  describe_splat_view(visitor, options_.view);
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
  blend.most_frames = std::min(blend.most_frames, static_cast<float>(options_.history));
  const TemporalMean mean = record_temporal_mean(graph, "indirect light", picture.gathered, view.reprojection(), blend);
  if (!mean.has_history) still_frames_.note_no_history();
  const ImageHandle irradiance =
      options_.filter ? record_noise_filter(graph, "indirect light", mean, view.gbuffer, view.camera, kPathFilter)
                      : mean.mean;
  views_ = {{"accumulation", picture.gathered}, {"normalised", mean.mean}};
  add_splat_views(graph, view, world, picture, views_);
  const bool every_frame_alike = options_.photons.same_photons;
  return {.irradiance = irradiance,
          .steady = options_.history == 0 || every_frame_alike || still_frames_.steady() + 1 >= kSteadyFrames};
}

}  // namespace lightwell
