// Preset `best`: an estimate of the photons' density, its mean over frames. README.md tells how and why.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "passes/noise_filter/still_frames.h"
#include "techniques/photon_splatting/splat_view.h"
#include "techniques/photon_splatting/world_part.h"
#include "techniques/technique.h"

namespace lightwell {

struct PhotonSplattingBestOptions {
  PhotonOptions photons{.bounces = 8, .guide = true, .kernel_photons = 48.0f, .most_width = 0.05f};
  SplatViewOptions view{.tolerance = 0.25f, .sampling = 1};
  int history = 1024;  // frames
  bool filter = true;
};

class PhotonSplattingBest final : public Technique {
 public:
  explicit PhotonSplattingBest(const PhotonSplattingBestOptions& options = {}) : options_(options) {}

  void describe(OptionVisitor& visitor) override;
  LightKinds covers(LightKinds) const override { return LightKinds::kBounced; }
  std::unique_ptr<TechniqueWorld> create_world(LightKinds) const override {
    return std::make_unique<PhotonWorld>(options_.photons);
  }
  GiResult record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) override;
  std::span<const DebugView> debug_views() const override { return views_; }

 private:
  PhotonSplattingBestOptions options_;
  StillFrames still_frames_{{.fading_frames = 16, .sees_lights = true}};
  std::shared_ptr<bool> warned_ = std::make_shared<bool>(false);  // that lists do not fit
  std::vector<DebugView> views_;                                  // of this frame
};

}  // namespace lightwell
