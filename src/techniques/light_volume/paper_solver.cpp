#include "techniques/light_volume/paper_solver.h"

namespace lightwell {

void LightVolumePaper::describe(OptionVisitor& visitor) {
  // At 256^3 the largest buffer, of light, has 768 MiB: where a device cannot bind that, one line says so.
  visitor.visit({"resolution", "Cells along the longest axis of the grid.", "cells",
                 "time and memory with its cube; light needs more steps to cross the scene", OptionScope::kWorld},
                options_.resolution, 8, 256);
  visitor.visit(
      {"steps", "Propagation steps; light moves one cell a step.", "", "time in proportion", OptionScope::kWorld},
      options_.steps, 1, 1024);
  if (variant_ == PaperVariant::kKaplanyan) return;  // reflects nothing after the first bounce
  visitor.visit({"reflectance", "Albedo of all surfaces after the first bounce.", "", "", OptionScope::kWorld},
                options_.reflectance, 0.0f, 1.0f);
}

void LightVolumePaperWorld::record_world(FrameGraph& graph, WorldFrame& world) {
  grid_ = fit_voxel_grid(world.grid_bounds, static_cast<std::uint32_t>(options_.resolution));
  const BufferHandle voxels = record_paper_voxels(graph, world.scene, world.lights, world.shadows(), grid_);
  volume_ = record_paper_injection(graph, grid_, voxels);
  received_ = record_paper_propagation(graph, grid_, volume_,
                                       {.steps = static_cast<std::uint32_t>(options_.steps),
                                        .reflectance = options_.reflectance,
                                        .occlusion = variant_ == PaperVariant::kMavridis});
}

ImageHandle LightVolumePaperWorld::record_lookup(FrameGraph& graph, const GBuffer& gbuffer) const {
  return record_paper_lookup(graph, grid_, volume_, received_, gbuffer, variant_ == PaperVariant::kMavridis);
}

GiResult LightVolumePaper::record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) {
  return {.irradiance = static_cast<LightVolumePaperWorld*>(world)->record_lookup(graph, view.gbuffer)};
}

}  // namespace lightwell
