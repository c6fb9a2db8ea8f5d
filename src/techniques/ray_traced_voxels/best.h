// Preset `best`: rays from the pixels, answered by a cache of light on the faces of voxels. README.md tells how and
// why.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "passes/light_cache/light_cache.h"
#include "passes/noise_filter/still_frames.h"
#include "techniques/technique.h"

namespace lightwell {

struct RayTracedVoxelsBestOptions {
  LightCacheOptions cache;  // of the world
  int rays = 1;             // a pixel and frame; 0: the cache alone
  int history = 1024;       // frames
  bool filter = true;
};

struct RayTracedVoxelsBestWorld final : TechniqueWorld {
  explicit RayTracedVoxelsBestWorld(const LightCacheOptions& options) : cache(options) {}
  void record_world(FrameGraph& graph, WorldFrame& world) override { cache.record(graph, world); }
  std::map<std::string, std::uint64_t> counts() const override { return cache.counts(); }
  BufferHandle record_points(FrameGraph& graph, WorldFrame&, const Points& points) override {
    return cache.record_points(graph, points.points, points.count);
  }

  LightCache cache;
};

class RayTracedVoxelsBest final : public Technique {
 public:
  explicit RayTracedVoxelsBest(const RayTracedVoxelsBestOptions& options = {}) : options_(options) {}

  void describe(OptionVisitor& visitor) override;
  LightKinds covers(LightKinds) const override { return LightKinds::kBounced; }
  std::unique_ptr<TechniqueWorld> create_world(LightKinds) const override {
    return std::make_unique<RayTracedVoxelsBestWorld>(options_.cache);
  }
  GiResult record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) override;
  std::span<const DebugView> debug_views() const override { return views_; }

 private:
  struct RayEnds {  // cache_memory.glsl
    ImagePair first, last;
  };
  ImageHandle record_rays(FrameGraph& graph, LightCache& cache, const ViewFrame& view, RayEnds& ends) const;
  ImageHandle record_limits(FrameGraph& graph, const LightCache& cache, ViewFrame& view, const RayEnds& ends) const;
  ImageHandle record_gathered(FrameGraph& graph, LightCache& cache, ViewFrame& view);

  RayTracedVoxelsBestOptions options_;
  StillFrames still_frames_{{.fading_frames = 32, .sees_lights = true, .fades_at_first = true}};
  std::vector<DebugView> views_;  // of this frame
};

}  // namespace lightwell
