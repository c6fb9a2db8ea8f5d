// Preset `best` of the light volume: pixels read a cache of light on the faces of voxels. README.md tells how and why.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "passes/light_cache/light_cache.h"
#include "techniques/technique.h"

namespace lightwell {

struct LightVolumeBestWorld final : TechniqueWorld {
  explicit LightVolumeBestWorld(const LightCacheOptions& options) : cache(options) {}
  void record_world(FrameGraph& graph, WorldFrame& world) override { cache.record(graph, world); }
  std::map<std::string, std::uint64_t> counts() const override { return cache.counts(); }
  BufferHandle record_points(FrameGraph& graph, WorldFrame& world, const Points& points) override;

  LightCache cache;
};

class LightVolumeBest final : public Technique {
 public:
  static constexpr LightCacheOptions kDefaults{.resolution = 32,
                                               .links = 128,
                                               .links_per_frame = 8,
                                               .bounces_per_frame = 4,
                                               .rests = true,
                                               .sees_neighbours = true};

  explicit LightVolumeBest(const LightCacheOptions& options = kDefaults) : options_(options) {}

  void describe(OptionVisitor& visitor) override { LightCache::describe(visitor, options_); }
  LightKinds covers(LightKinds) const override { return LightKinds::kBounced; }
  std::unique_ptr<TechniqueWorld> create_world(LightKinds) const override {
    return std::make_unique<LightVolumeBestWorld>(options_);
  }
  GiResult record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) override;
  std::span<const DebugView> debug_views() const override { return views_; }

 private:
  LightCacheOptions options_;
  std::vector<DebugView> views_;  // of this frame
};

}  // namespace lightwell
