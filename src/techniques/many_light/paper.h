// many_light as published: Sun and Agu 2015, "Many-light real-time global illumination using sparse voxel octree".
#pragma once

#include <span>
#include <vector>

#include "techniques/many_light/visibility.h"
#include "techniques/many_light/world_part.h"
#include "techniques/technique.h"

namespace lightwell {

struct ManyLightPaperOptions {
  float clamp = 0.02f;            // sqrt(B), of the scene's diagonal
  float filter_distance = 0.02f;  // of the scene's diagonal
  float filter_angle = 30.0f;     // degrees
};

class ManyLightPaper final : public Technique {
 public:
  ManyLightPaper();

  void describe(OptionVisitor& visitor) override;
  LightKinds covers(LightKinds) const override { return LightKinds::kBounced; }
  std::unique_ptr<TechniqueWorld> create_world(LightKinds) const override {
    return std::make_unique<ManyLightWorld>(world_options_);
  }
  GiResult record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) override;
  std::span<const DebugView> debug_views() const override { return views_; }

 private:
  ManyLightWorldOptions world_options_;
  ManyLightPaperOptions options_;
  std::vector<DebugView> views_;  // of this frame
};

}  // namespace lightwell
