// The stages of the published light volume as graph passes. Buffers and parameters: paper_types.h.
#pragma once

#include "passes/gbuffer/gbuffer.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/lights/light_table.h"
#include "passes/shadow_maps/shadow_maps.h"
#include "passes/voxel_grid/voxel_grid.h"

namespace lightwell {

// What one cell looks like to light, and the light in it that the next step will move.
struct PaperVolume {
  BufferHandle cells;  // vec4 a cell: unit normal (or zero), 1 where occupied
  BufferHandle light;  // kPaperLightPlanes floats a cell: radiance by direction of travel, W/(sr m^2)
};

struct PaperTransport {
  std::uint32_t steps = 0;
  float reflectance = 0.5f;  // of every surface after the first bounce
  bool occlusion = true;     // false: light propagation volumes
};

// Three slicings of the scene, one along each axis, combined with MAX: kPaperVoxelPlanes words a cell.
BufferHandle record_paper_voxels(FrameGraph& graph, const GpuScene::Frame& scene, const LightTable::Frame& lights,
                                 const ShadowMaps::Frame& shadows, const VoxelGrid& grid);

// Voxels turned into virtual point lights.
PaperVolume record_paper_injection(FrameGraph& graph, const VoxelGrid& grid, BufferHandle voxels);

// Moves the light `steps` cells far. Returns what cells received on the way (kPaperLightPlanes floats a cell): occupied
// ones only, or all without occlusion. The light that was injected is not part of it.
BufferHandle record_paper_propagation(FrameGraph& graph, const VoxelGrid& grid, PaperVolume& volume,
                                      const PaperTransport& transport);

// Irradiance (W/m^2) at each pixel of the G-buffer.
ImageHandle record_paper_lookup(FrameGraph& graph, const VoxelGrid& grid, const PaperVolume& volume,
                                BufferHandle received, const GBuffer& gbuffer, bool occlusion);

}  // namespace lightwell
