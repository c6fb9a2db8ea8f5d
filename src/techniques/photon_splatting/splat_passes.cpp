#include "techniques/photon_splatting/splat_passes.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "core/log.h"
#include "graph/linear_dispatch.h"
#include "kernels/techniques/photon_splatting/splat_bounds.comp.h"
#include "kernels/techniques/photon_splatting/splat_cells_view.comp.h"
#include "kernels/techniques/photon_splatting/splat_count.comp.h"
#include "kernels/techniques/photon_splatting/splat_gather.comp.h"
#include "kernels/techniques/photon_splatting/splat_maps_view.comp.h"
#include "kernels/techniques/photon_splatting/splat_ranges.comp.h"
#include "kernels/techniques/photon_splatting/splat_spread.comp.h"
#include "kernels/techniques/photon_splatting/splat_tiles.comp.h"
#include "kernels/techniques/photon_splatting/splat_write.comp.h"
#include "lightwell/error.h"
#include "passes/sort/sort.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kWord = sizeof(std::uint32_t);
constexpr std::uint32_t kMostEntries = 1u << 30;

// Splats that one invocation sorts, at least, and counters of all: more parts are more invocations side by side, and
// more counters to add up.
constexpr std::uint32_t kLeastPart = 16;
constexpr std::uint32_t kLeastParts = 64;
constexpr std::uint32_t kMostCounters = 1u << 21;

glm::uvec2 divide_up(glm::uvec2 a, std::uint32_t b) {
  return (a + b - 1u) / b;
}

glm::uvec2 size_of(const GBuffer& gbuffer) {
  return {gbuffer.width, gbuffer.height};
}

// Pixels of a block take turns such that those of a few frames are far apart: in each bit of their place from the
// highest on, along both diagonals of 2x2.
glsl::SplatSamples samples_of(const SplatScreen& screen) {
  LW_ASSERT(std::has_single_bit(screen.sampling.stride), "samples of a stride that is no power of two");
  glm::uvec2 turn(0);
  auto frame = static_cast<std::uint32_t>(screen.sampling.frame);
  for (std::uint32_t side = screen.sampling.stride / 2; side > 0; side /= 2, frame /= 4)
    turn += side * glm::uvec2((frame ^ (frame >> 1)) & 1, frame & 1);
  return {size_of(screen.gbuffer), screen.sampling.stride, turn.x + 256 * turn.y};
}

glm::uvec2 sample_count(const SplatScreen& screen) {
  return divide_up(size_of(screen.gbuffer), screen.sampling.stride);
}

// Side, samples: where samples are far apart few splats light all of a tile.
std::uint32_t tile_side(const SplatScreen& screen) {
  return screen.sampling.stride == 1 ? glsl::kSplatTile : glsl::kSparseSplatTile;
}

ImageHandle create_picture(FrameGraph& graph, std::string_view name, glm::uvec2 size) {
  return graph.create_image(name, {.width = size.x, .height = size.y, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
}

// What the device finds out arrives later, and is told once.
void watch_totals(FrameGraph& graph, BufferHandle totals, std::uint64_t memory, std::shared_ptr<bool> warned) {
  graph.watch(totals, [warned = std::move(warned), memory](std::span<const std::byte> bytes) {
    glm::uvec2 total;
    std::memcpy(&total, bytes.data(), sizeof(total));
    if (*warned || total.y == 0) return;
    *warned = true;
    log_warning("photon-splatting: lists of splats do not fit into list-memory (" + std::to_string(memory >> 20) +
                " MiB): one of " + std::to_string(1u << total.y) + " splats counts for all");
  });
}

}  // namespace

SplatLists record_splat_lists(FrameGraph& graph, const SplatScreen& screen, const Splats& splats,
                              SplatEstimate estimate, std::uint64_t memory, const std::shared_ptr<bool>& warned) {
  const GBuffer& gbuffer = screen.gbuffer;
  const glm::uvec2 tiles = divide_up(sample_count(screen), tile_side(screen));
  const std::uint32_t tile_count = tiles.x * tiles.y;
  LW_ASSERT(std::max(tiles.x, tiles.y) <= glsl::kMostSplatTiles, "a picture of too many tiles");
  BufferHandle bounds = graph.create_buffer("bounds of splats", splats.capacity, sizeof(glsl::SplatBounds));
  BufferHandle tile_surfaces = graph.create_buffer("surfaces of tiles", tile_count, sizeof(glsl::SplatTile));
  dispatch_linear(graph.compute("splats: bounds", kernels::photon_splatting_splat_bounds_comp)
                      .read("splats", splats.splats)
                      .read("counts", splats.counts)
                      .read("camera", screen.camera_buffer)
                      .write("bounds", bounds)
                      .push(glsl::SplatBoundsParams{tiles, tile_side(screen) * screen.sampling.stride}),
                  splats.capacity);
  graph.compute("splats: tiles", kernels::photon_splatting_splat_tiles_comp)
      .read("position", gbuffer.position)
      .read("face", gbuffer.face)
      .write("tiles", tile_surfaces)
      .constant("kTile", tile_side(screen))
      .push(glsl::SplatTileParams{samples_of(screen)})
      .dispatch(tiles.x, tiles.y);

  const std::uint32_t parts = std::clamp((splats.capacity + kLeastPart - 1) / kLeastPart, 1u,
                                         std::max(kLeastParts, kMostCounters / tile_count));
  const std::uint32_t counters = tile_count * parts;
  const auto capacity = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(memory / kWord, 1, kMostEntries));
  const glsl::SplatListParams params{tiles, parts, std::max(1u, kMostEntries / counters), capacity};
  const auto bind = [&](ComputePass& pass) -> ComputePass& {
    return pass.read("splats", splats.splats)
        .read("counts", splats.counts)
        .read("bounds", bounds)
        .read("tiles", tile_surfaces)
        .constant("kEstimate", static_cast<std::uint32_t>(estimate))
        .push(params);
  };
  BufferHandle part_counts = graph.create_buffer("splats of parts", counters + 1, kWord);
  graph.fill("splats: clear", part_counts, 0);
  dispatch_linear(
      bind(
          graph.compute("splats: count", kernels::photon_splatting_splat_count_comp).write("part_counts", part_counts)),
      parts);
  const PrefixSums places = record_prefix_sums(graph, "splats: places", part_counts, counters + 1);
  SplatLists lists{graph.create_buffer("ranges of splats", tile_count, sizeof(glm::uvec2)),
                   graph.create_buffer("lists of splats", capacity, kWord),
                   graph.create_buffer("totals of splats", 1, sizeof(glm::uvec2))};
  dispatch_linear(graph.compute("splats: ranges", kernels::photon_splatting_splat_ranges_comp)
                      .read("sums", places.sums)
                      .read("blocks", places.blocks)
                      .write("ranges", lists.ranges)
                      .write("totals", lists.totals)
                      .push(params),
                  tile_count);
  dispatch_linear(bind(graph.compute("splats: lists", kernels::photon_splatting_splat_write_comp)
                           .read("sums", places.sums)
                           .read("blocks", places.blocks)
                           .write("part_counts", part_counts)
                           .write("entries", lists.entries)),
                  parts);
  if (warned) watch_totals(graph, lists.totals, memory, warned);
  return lists;
}

ImageHandle record_splat_gather(FrameGraph& graph, const SplatScreen& screen, const Splats& splats,
                                const SplatLists& lists, const SplatRules& rules, std::uint32_t show) {
  constexpr float kDotRadius = 1.5f;  // pixels
  const GBuffer& gbuffer = screen.gbuffer;
  const glm::uvec2 groups = divide_up(sample_count(screen), glsl::kSplatTile);
  ImageHandle gathered = create_picture(graph, "gathered splats", sample_count(screen));
  graph.compute("splats: gather", kernels::photon_splatting_splat_gather_comp)
      .read("splats", splats.splats)
      .read("ranges", lists.ranges)
      .read("entries", lists.entries)
      .read("totals", lists.totals)
      .read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("face", gbuffer.face)
      .read("shadow_atlas", splats.shadow_atlas)
      .write("gathered", gathered)
      .constant("kEstimate", static_cast<std::uint32_t>(rules.estimate))
      .constant("kKernel", static_cast<std::uint32_t>(rules.kernel))
      .constant("kShow", show)
      .constant("kTile", tile_side(screen))
      .push(glsl::SplatGatherParams{.samples = samples_of(screen),
                                    .map_side = splats.map_side,
                                    .maps_per_row = splats.maps_per_row,
                                    .tolerance = rules.tolerance,
                                    .scale = rules.scale,
                                    .dot_tangent = kDotRadius * pixel_tangent(screen.camera)})
      .dispatch(groups.x, groups.y);
  return gathered;
}

ImageHandle record_splat_spread(FrameGraph& graph, const SplatScreen& screen, ImageHandle gathered) {
  const glm::uvec2 size = size_of(screen.gbuffer);
  ImageHandle light = create_picture(graph, "light of splats", size);
  graph.compute("splats: spread", kernels::photon_splatting_splat_spread_comp)
      .read("position", screen.gbuffer.position)
      .read("normal", screen.gbuffer.normal)
      .read("gathered", gathered)
      .write("light", light)
      .push(glsl::SplatSpreadParams{samples_of(screen), pixel_tangent(screen.camera)})
      .dispatch_threads(size.x, size.y);
  return light;
}

ImageHandle record_shadow_atlas_view(FrameGraph& graph, const SplatScreen& screen, const Splats& splats) {
  const glm::uvec2 size = size_of(screen.gbuffer);
  ImageHandle picture = create_picture(graph, "shadow maps", size);
  graph.compute("splats: maps", kernels::photon_splatting_splat_maps_view_comp)
      .read("splats", splats.splats)
      .read("counts", splats.counts)
      .read("shadow_atlas", splats.shadow_atlas)
      .write("picture", picture)
      .push(glsl::SplatMapsParams{size, splats.map_side, splats.maps_per_row})
      .dispatch_threads(size.x, size.y);
  return picture;
}

ImageHandle record_splat_cells_view(FrameGraph& graph, const SplatScreen& screen, const VoxelGrid& grid) {
  const glm::uvec2 size = size_of(screen.gbuffer);
  ImageHandle picture = create_picture(graph, "cells of photons", size);
  graph.compute("splats: cells", kernels::photon_splatting_splat_cells_view_comp)
      .read("position", screen.gbuffer.position)
      .write("picture", picture)
      .push(glsl::SplatCellsParams{grid, size})
      .dispatch_threads(size.x, size.y);
  return picture;
}

}  // namespace lightwell
