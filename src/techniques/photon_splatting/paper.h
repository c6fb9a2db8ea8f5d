// Preset `paper`: colours of photons weighted and divided by their weights, as published. README.md tells how.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "techniques/photon_splatting/splat_view.h"
#include "techniques/photon_splatting/world_part.h"
#include "techniques/technique.h"

namespace lightwell {

struct PhotonSplattingPaperOptions {
  PhotonOptions photons{.photons = 25000,
                        .bounces = 1,
                        .same_photons = true,
                        .width_mode = SplatWidth::kFixed,
                        .width = 0.1f,
                        .most_width = 1.0f,
                        .step_back = 0.1f,
                        .kernel = SplatKernel::kTent,
                        .receiver_test = false};
  SplatViewOptions view{.tolerance = 1.0f};
  float exposure = 1.0f;
  float ambient = 0.0f;  // W/m^2
  int blur = 0;          // taps are 2 blur + 1
};

class PhotonSplattingPaper final : public Technique {
 public:
  explicit PhotonSplattingPaper(const PhotonSplattingPaperOptions& options = {}) : options_(options) {}

  void describe(OptionVisitor& visitor) override;
  LightKinds covers(LightKinds) const override { return LightKinds::kBounced; }
  std::unique_ptr<TechniqueWorld> create_world(LightKinds) const override {
    return std::make_unique<PhotonWorld>(options_.photons);
  }
  GiResult record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) override;
  std::span<const DebugView> debug_views() const override { return views_; }

 private:
  PhotonSplattingPaperOptions options_;
  std::shared_ptr<bool> warned_ = std::make_shared<bool>(false);  // that lists do not fit
  std::vector<DebugView> views_;                                  // of this frame
};

}  // namespace lightwell
