// Preset `best`: light points sampled by contribution, one to four shadow rays a pixel. README.md tells how and why.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "passes/light_clusters/light_sampler.h"
#include "techniques/many_light/visibility.h"
#include "techniques/many_light/world_part.h"
#include "techniques/technique.h"

namespace lightwell {

struct ManyLightBestOptions {
  float clamp = 0.06f;  // least distance, of the scene's diagonal
  int candidates = 16;
  int rays = 2;
  int near_bounces = 2;  // of short rays
  int history = 1024;    // frames
  bool filter = true;
};

class ManyLightBest final : public Technique {
 public:
  ManyLightBest() = default;

  void describe(OptionVisitor& visitor) override;
  LightKinds covers(LightKinds) const override { return LightKinds::kBounced; }
  std::unique_ptr<TechniqueWorld> create_world(LightKinds) const override {
    return std::make_unique<ManyLightWorld>(world_options_);
  }
  GiResult record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) override;
  std::span<const DebugView> debug_views() const override { return views_; }

 private:
  struct Gathering;
  bool is_last(std::uint32_t depth) const;
  ImageHandle gather(FrameGraph& graph, Gathering& g, const Receivers& receivers, std::uint32_t depth);
  ImageHandle add_nearby(FrameGraph& graph, Gathering& g, const Receivers& receivers, ImageHandle far,
                         std::uint32_t depth);
  ImageHandle record_limits(FrameGraph& graph, const ManyLightWorld& world, ViewFrame& view,
                            ImageHandle last_memory) const;
  void note_changes(const ViewFrame& view);

  ManyLightWorldOptions world_options_;
  ManyLightBestOptions options_;
  std::vector<DebugView> views_;  // of this frame
  // Of the last declared frame.
  SceneRevisions revisions_;
  glm::mat4 camera_{0.0f};
  int steady_frames_ = 0;
};

}  // namespace lightwell
