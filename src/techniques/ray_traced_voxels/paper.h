// Ray-traced voxels as published: Magalhaes 2020, "Real-time ray traced voxel global illumination".
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "techniques/ray_traced_voxels/paper_passes.h"
#include "techniques/technique.h"

namespace lightwell {

enum class VoxelInjection { kLight, kCamera };

struct RayTracedVoxelsPaperOptions {
  int resolution = 128;
  int rays = 512;  // side of the square of rays
  VoxelWriter writer = VoxelWriter::kAverage;
  VoxelInjection inject = VoxelInjection::kLight;
  int secondaries = 0;
  float irradiance_range = 0.0f;  // W/m^2; 0: choose_irradiance_range()
  bool trace_voxels = false;
  int taps = 7;          // of the view
  float ambient = 0.2f;  // of the view
};

class RayTracedVoxelsPaperWorld final : public TechniqueWorld {
 public:
  explicit RayTracedVoxelsPaperWorld(const RayTracedVoxelsPaperOptions& options) : options_(options) {}

  void record_world(FrameGraph& graph, WorldFrame& world) override;
  // Where lights inject; empty where a camera does.
  BufferHandle record_points(FrameGraph& graph, WorldFrame& world, const Points& points) override;

  // Of this frame, for views.
  const PaperMaterials& materials() const { return materials_; }
  // The grid for a view: of all of them where lights inject, its own where its camera does.
  PaperIrradiance record_irradiance(FrameGraph& graph, ViewFrame& view);

 private:
  RayTracedVoxelsPaperOptions options_;
  ExactSums sums_;  // of this frame, as the others
  PaperMaterials materials_;
  PaperInjection injection_;
  PaperIrradiance irradiance_;  // where lights inject
  bool warned_ = false;         // of lights that do not shine
};

class RayTracedVoxelsPaper final : public Technique {
 public:
  explicit RayTracedVoxelsPaper(const RayTracedVoxelsPaperOptions& options = {}) : options_(options) {}

  void describe(OptionVisitor& visitor) override;
  // Direct light lies in the grid. Emissive surfaces and the environment are not in the published technique.
  LightKinds covers(LightKinds) const override { return LightKinds::kLights | LightKinds::kBounced; }
  std::unique_ptr<TechniqueWorld> create_world(LightKinds) const override {
    return std::make_unique<RayTracedVoxelsPaperWorld>(options_);
  }
  GiResult record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) override;
  std::span<const DebugView> debug_views() const override { return views_; }

 private:
  RayTracedVoxelsPaperOptions options_;
  std::vector<DebugView> views_;  // of this frame
};

}  // namespace lightwell
