#include "techniques/photon_splatting/paper.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "techniques/photon_splatting/paper_passes.h"

namespace lightwell {
namespace {

// m^2 of a box's faces.
float area_of(const Bounds& bounds) {
  const glm::vec3 size = bounds.maximum - bounds.minimum;
  return 2.0f * (size.x * size.y + size.y * size.z + size.z * size.x);
}

}  // namespace

void PhotonSplattingPaper::describe(OptionVisitor& visitor) {
  describe_photon_options(visitor, options_.photons);
  describe_splat_view(visitor, options_.view);
  visitor.visit({"exposure",
                 "Brightness of indirect light, which has no unit here: 1 where the light of all photons falls evenly "
                 "on the sides of the scene's box.",
                 "", ""},
                options_.exposure, 0.0f, 1000.0f);
  visitor.visit({"ambient", "Irradiance of pixels that no splat lights.", "W/m^2", ""}, options_.ambient, 0.0f, 1e6f);
  constexpr std::array<std::string_view, 5> kTaps{"0", "3", "5", "7", "9"};
  visitor.visit({"blur", "Taps of a Gaussian filter across and down; 0: none.", "pixels", "time in proportion"},
                options_.blur, kTaps);
}

GiResult PhotonSplattingPaper::record_view(FrameGraph& graph, TechniqueWorld* world_part, ViewFrame& view) {
  const auto& world = *static_cast<PhotonWorld*>(world_part);
  // A splat's flux is its part of what all photons bring; its colour is that of all of them.
  const float area = std::max(area_of(view.world.snapshot.bounds), 1e-20f);
  const SplatRules rules{.estimate = SplatEstimate::kMean, .scale = static_cast<float>(world.options().photons) / area};
  const SplatPicture picture = record_splat_picture(graph, view, world, options_.view, rules, warned_);
  const ImageHandle normalised =
      record_paper_normalise(graph, view.gbuffer, picture.gathered, options_.exposure, options_.ambient);
  const ImageHandle irradiance = record_paper_blur(graph, normalised, static_cast<std::uint32_t>(options_.blur));
  views_ = {{"accumulation", picture.gathered}, {"normalised", normalised}};
  add_splat_views(graph, view, world, options_.view, picture, views_);
  return {.irradiance = irradiance, .steady = options_.photons.same_photons};
}

}  // namespace lightwell
