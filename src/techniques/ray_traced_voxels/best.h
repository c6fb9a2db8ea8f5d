// Preset `best`: rays from the pixels, answered by a cache of light on the faces of voxels. README.md tells how and
// why.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "passes/noise_filter/still_frames.h"
#include "techniques/ray_traced_voxels/cache_world.h"
#include "techniques/technique.h"

namespace lightwell {

struct RayTracedVoxelsBestOptions {
  LightCacheOptions cache;
  int rays = 1;        // a pixel and frame; 0: the cache alone
  int history = 1024;  // frames
  bool filter = true;
};

class RayTracedVoxelsBest final : public Technique {
 public:
  explicit RayTracedVoxelsBest(const RayTracedVoxelsBestOptions& options = {}) : options_(options) {}

  void describe(OptionVisitor& visitor) override;
  LightKinds covers(LightKinds) const override { return LightKinds::kBounced; }
  std::unique_ptr<TechniqueWorld> create_world(LightKinds) const override {
    return std::make_unique<LightCacheWorld>(options_.cache);
  }
  GiResult record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) override;
  std::span<const DebugView> debug_views() const override { return views_; }

 private:
  struct RayEnds {  // cache_memory.glsl
    ImagePair first, last;
  };
  ImageHandle record_look_up(FrameGraph& graph, LightCacheWorld& cache, const ViewFrame& view) const;
  ImageHandle record_rays(FrameGraph& graph, LightCacheWorld& cache, const ViewFrame& view, RayEnds& ends) const;
  ImageHandle record_limits(FrameGraph& graph, const LightCacheWorld& cache, ViewFrame& view,
                            const RayEnds& ends) const;
  ImageHandle record_gathered(FrameGraph& graph, LightCacheWorld& cache, ViewFrame& view);
  ImageHandle record_cache_view(FrameGraph& graph, const LightCacheWorld& cache, const ViewFrame& view,
                                bool shows_indirect) const;

  RayTracedVoxelsBestOptions options_;
  StillFrames still_frames_{{.fading_frames = 32, .sees_lights = true, .fades_at_first = true}};
  std::vector<DebugView> views_;  // of this frame
};

}  // namespace lightwell
