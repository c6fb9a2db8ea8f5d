// The view's part of photon splatting: splats sorted to the tiles of a picture, and gathered there.
#pragma once

#include <cstdint>
#include <memory>

#include "graph/frame_graph.h"
#include "lightwell/options.h"
#include "passes/camera/camera.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/voxel_grid/voxel_grid.h"
#include "techniques/photon_splatting/shadow_atlas.h"
#include "techniques/photon_splatting/splat_view_types.h"

namespace lightwell {

// What the world part has made.
struct Splats {
  BufferHandle splats;         // glsl::StoredSplat
  BufferHandle counts;         // words; [0]: splats in use
  std::uint32_t capacity = 0;  // splats
  ImageHandle shadow_atlas;    // R32F; m from the plane at -reach along a splat's ray to the first surface
  std::uint32_t map_side = 0;  // texels
  std::uint32_t maps_per_row = 0;
};

// Where light is gathered: in a frame at one pixel of each block, another one in each. Its mean over frames is every
// pixel's own.
struct SplatSampling {
  std::uint32_t stride = 1;  // side of a block, pixels: 1, 2 or 4
  std::uint64_t frame = 0;
};

// What they light: the surfaces that a camera sees.
struct SplatScreen {
  GBuffer gbuffer;
  glsl::GpuCamera camera;
  BufferHandle camera_buffer;  // the same, uniform
  SplatSampling sampling;
};

enum class SplatEstimate : std::uint32_t { kMean = glsl::kEstimateMean, kDensity = glsl::kEstimateDensity };
struct SplatRules {
  SplatEstimate estimate = SplatEstimate::kDensity;
  SplatKernel kernel = SplatKernel::kBox;
  float tolerance = 0.5f;  // how far behind its map's depth a surface is still lit, texels
  float scale = 1.0f;      // of the colours of a mean
};

// For each tile of the picture, the splats that may light it, in the order of their numbers.
struct SplatLists {
  BufferHandle ranges;   // uvec2 a tile: first entry, end
  BufferHandle entries;  // uint: number of a splat
  BufferHandle totals;   // uvec2: entries wanted; shift by which lists were thinned to fit
};

// `memory`: of the lists, bytes. Where they need more they are thinned: fewer splats that count for more. That shows as
// noise, is no error in the mean, and is said once: `warned` lasts over the frames; null: it is not said.
SplatLists record_splat_lists(FrameGraph& graph, const SplatScreen& screen, const Splats& splats,
                              SplatEstimate estimate, std::uint64_t memory, const std::shared_ptr<bool>& warned);

// RGBA32F, a texel a sample. A density: xyz E (W/m^2). A mean: xyz the sum of weight, cosine and colour, w of weights.
ImageHandle record_splat_gather(FrameGraph& graph, const SplatScreen& screen, const Splats& splats,
                                const SplatLists& lists, const SplatRules& rules,
                                std::uint32_t show = glsl::kShowLight);

// RGBA32F of the view's size: of a density that was gathered at samples, each pixel's xyz E (W/m^2), from those near it
// on its own surface; w: weight in a mean over frames, little where there is no such.
ImageHandle record_splat_spread(FrameGraph& graph, const SplatScreen& screen, ImageHandle gathered);

// RGBA32F: the first splats' shadow maps, the nearer the surfaces the darker.
ImageHandle record_shadow_atlas_view(FrameGraph& graph, const SplatScreen& screen, const Splats& splats);

// RGBA32F: the grid's cell in which each surface lies, as a colour.
ImageHandle record_splat_cells_view(FrameGraph& graph, const SplatScreen& screen, const VoxelGrid& grid);

}  // namespace lightwell
