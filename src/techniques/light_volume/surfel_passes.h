// The stages of the surfel solver as graph passes. Buffers and parameters: surfel_types.h.
#pragma once

#include "passes/view/view_frame.h"
#include "passes/voxel_grid/voxel_grid.h"
#include "techniques/light_volume/surfel_types.h"
#include "techniques/points.h"

namespace lightwell {

// All that survives from frame to frame.
struct SurfelVolume {
  BufferHandle counts;      // uint, words as in surfel_types.h
  BufferHandle table;       // uint a cell: where its surfels are
  BufferHandle bricks;      // 64 bits a brick of 4x4x4 cells: which of them hold surfels
  BufferHandle surfels;     // glsl::Surfel
  BufferHandle links;       // uint
  BufferHandle summaries;   // glsl::LinkSummary
  BufferHandle emitters;    // glsl::SurfelEmitter
  BufferHandle irradiance;  // vec4 a surfel: indirect irradiance E, W/m^2
  BufferHandle lit;         // glsl::LitSurfel: what pixels read
};

struct SurfelSizes {
  std::uint32_t capacity = 0;  // surfels
  std::uint32_t links = 0;     // a surfel
};

// Room for surfels grows with the area of the grid's faces, not with its volume: surfaces are thin. Links are as many
// as asked for, as long as they fit into the pages that every device can bind (512 MiB).
SurfelSizes choose_surfel_sizes(const VoxelGrid& grid, std::uint32_t links);

// `fresh`: some of it is undefined, so nothing of it can be used.
SurfelVolume find_surfel_volume(FrameGraph& graph, const VoxelGrid& grid, const SurfelSizes& sizes, bool& fresh);

// Surfels from the scene's triangles. `keep`: those that were there before keep their light and links.
void record_surfels(FrameGraph& graph, SurfelVolume& volume, WorldFrame& world, const glsl::SurfelParams& params,
                    bool keep);

// Traces params.traced_links links of every surfel, and as many rays to emitters. `geometry_changed`: also finds
// which neighbours see each other.
void record_links(FrameGraph& graph, SurfelVolume& volume, WorldFrame& world, const glsl::SurfelParams& params,
                  bool geometry_changed);

// Light of the lights on every surfel, then `bounces` rounds of gathering, then the smoothed values for pixels.
void record_solution(FrameGraph& graph, SurfelVolume& volume, WorldFrame& world, const glsl::SurfelParams& params,
                     std::uint32_t bounces);

// Irradiance (W/m^2) at each pixel of the G-buffer.
ImageHandle record_surfel_lookup(FrameGraph& graph, const SurfelVolume& volume, const ViewFrame& view_frame,
                                 const glsl::SurfelParams& params);

// Irradiance at each point: a vec4 each, xyz in W/m^2.
BufferHandle record_surfel_points(FrameGraph& graph, const SurfelVolume& volume, const WorldFrame& world,
                                  const glsl::SurfelParams& params, const Points& points);

// The surfels themselves as pictures; `kind`: kView of surfel_view.comp.
ImageHandle record_surfel_view(FrameGraph& graph, const SurfelVolume& volume, const ViewFrame& view_frame,
                               const glsl::SurfelParams& params, std::uint32_t kind);

}  // namespace lightwell
