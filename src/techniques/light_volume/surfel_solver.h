// Preset `best` of the light volume: surfels on the grid's cells, linked by traced rays. README.md tells how and why.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "passes/voxel_grid/voxel_grid.h"
#include "techniques/light_volume/surfel_passes.h"
#include "techniques/technique.h"

namespace lightwell {

struct LightVolumeBestOptions {
  int resolution = 32;
  int links = 128;
  int links_per_frame = 8;
  int bounces_per_frame = 2;
};

class LightVolumeBestWorld final : public TechniqueWorld {
 public:
  LightVolumeBestWorld(const LightVolumeBestOptions& options, LightKinds covered)
      : options_(options), covered_(covered) {}

  void record_world(FrameGraph& graph, WorldFrame& world) override;
  BufferHandle record_points(FrameGraph& graph, WorldFrame& world, const Points& points) override;

  // Of this frame, for views. `params` lacks the picture's size.
  const SurfelVolume& volume() const { return volume_; }
  const glsl::SurfelParams& params() const { return params_; }
  bool is_steady() const;

 private:
  glsl::SurfelParams make_params(const WorldFrame& world, const SurfelSizes& sizes) const;

  LightVolumeBestOptions options_;
  LightKinds covered_;
  SurfelVolume volume_;
  glsl::SurfelParams params_{};
  std::optional<VoxelGrid> grid_;           // of last frame
  SceneRevisions revisions_;                // of what the surfels were made of and lit by
  std::uint32_t next_link_ = 0;             // first of those to be traced next
  std::uint32_t links_left_ = 0;            // how many have not been traced since the geometry changed
  std::uint32_t used_links_ = 0;            // links beyond these have never been traced
  std::uint32_t bounces_since_change_ = 0;  // of light or geometry
  std::uint32_t bounces_since_trace_ = 0;
};

class LightVolumeBest final : public Technique {
 public:
  explicit LightVolumeBest(const LightVolumeBestOptions& options = {}) : options_(options) {}

  void describe(OptionVisitor& visitor) override;
  std::unique_ptr<TechniqueWorld> create_world(LightKinds covered) const override {
    return std::make_unique<LightVolumeBestWorld>(options_, covered);
  }
  GiResult record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) override;
  std::span<const DebugView> debug_views() const override { return views_; }

 private:
  LightVolumeBestOptions options_;
  std::vector<DebugView> views_;  // of this frame
};

}  // namespace lightwell
