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
  bool surfel_views = false;
};

class LightVolumeBest final : public Technique {
 public:
  explicit LightVolumeBest(const LightVolumeBestOptions& options = {}) : options_(options) {}

  void describe(OptionVisitor& visitor) override;
  GiResult record(FrameGraph& graph, const FrameInputs& inputs) override;
  std::span<const DebugView> debug_views() const override { return views_; }

 private:
  VoxelGrid choose_grid(const Bounds& bounds);
  bool notice_light_changes(const FrameInputs& inputs);
  glsl::SurfelParams make_params(const FrameInputs& inputs, const SurfelSizes& sizes) const;
  bool is_steady() const;
  void record_views(FrameGraph& graph, const SurfelVolume& volume, const FrameInputs& inputs,
                    const glsl::SurfelParams& params);

  LightVolumeBestOptions options_;
  std::vector<DebugView> views_;            // of this frame
  std::optional<VoxelGrid> grid_;           // of last frame
  std::vector<WorldLight> lights_;          // of last frame
  SceneRevisions revisions_;                // of the scene that the surfels were made of
  std::uint32_t next_link_ = 0;             // first of those to be traced next
  std::uint32_t links_left_ = 0;            // how many have not been traced since the geometry changed
  std::uint32_t used_links_ = 0;            // links beyond these have never been traced
  std::uint32_t bounces_since_change_ = 0;  // of light or geometry
  std::uint32_t bounces_since_trace_ = 0;
};

}  // namespace lightwell
