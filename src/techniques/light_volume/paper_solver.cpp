#include "techniques/light_volume/paper_solver.h"

#include "techniques/light_volume/paper_passes.h"

namespace lightwell {

void LightVolumePaper::describe(OptionVisitor& visitor) {
  // 128^3 cells are 96 MiB of light in one buffer; the baseline device ends at 128 MiB.
  visitor.visit({"resolution", "Cells along the longest axis of the grid.", "cells",
                 "time and memory with its cube; light needs more steps to cross the scene"},
                options_.resolution, 8, 128);
  visitor.visit({"steps", "Propagation steps; light moves one cell a step.", "", "time in proportion"}, options_.steps,
                1, 1024);
  if (variant_ == Variant::kKaplanyan) return;  // reflects nothing after the first bounce
  visitor.visit({"reflectance", "Albedo of all surfaces after the first bounce.", "", ""}, options_.reflectance, 0.0f,
                1.0f);
}

GiResult LightVolumePaper::record(FrameGraph& graph, const FrameInputs& inputs) {
  const bool occlusion = variant_ == Variant::kMavridis;
  const VoxelGrid grid = fit_voxel_grid(inputs.grid_bounds, static_cast<std::uint32_t>(options_.resolution));
  const BufferHandle voxels = record_paper_voxels(graph, inputs, grid);
  PaperVolume volume = record_paper_injection(graph, grid, voxels);
  const BufferHandle received = record_paper_propagation(graph, grid, volume,
                                                         {.steps = static_cast<std::uint32_t>(options_.steps),
                                                          .reflectance = options_.reflectance,
                                                          .occlusion = occlusion});
  GiResult result;
  result.irradiance = record_paper_lookup(graph, grid, volume, received, inputs.gbuffer, occlusion);
  return result;
}

}  // namespace lightwell
