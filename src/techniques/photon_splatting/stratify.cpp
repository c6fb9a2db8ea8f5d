#include "techniques/photon_splatting/stratify.h"

#include <algorithm>
#include <bit>

#include "graph/linear_dispatch.h"
#include "kernels/techniques/photon_splatting/bundle_make.comp.h"
#include "kernels/techniques/photon_splatting/stratify_begin.comp.h"
#include "kernels/techniques/photon_splatting/stratify_heads.comp.h"
#include "kernels/techniques/photon_splatting/stratify_keys.comp.h"
#include "kernels/techniques/photon_splatting/stratify_merge.comp.h"
#include "passes/sort/sort.h"
#include "passes/voxel_grid/voxel_grid.h"
#include "techniques/photon_splatting/stratify_types.h"

namespace lightwell {
namespace {

constexpr std::string_view kName = "photon splatting: stratify";
constexpr std::uint64_t kSplatGroupsOffset = glsl::kSplatGroups * sizeof(std::uint32_t);

// Light points in the order of their cells.
struct SortedPoints {
  glsl::StratifyParams params;
  BufferHandle sorted;        // uvec2: cell, light point
  BufferHandle point_counts;  // glsl::kPointCountWords
};

SortedPoints sort_points(FrameGraph& graph, BufferHandle points, const glsl::StratifyParams& params) {
  SortedPoints result{.params = params, .point_counts = begin_point_counts(graph)};
  BufferHandle keys = graph.create_buffer("light point cells", params.point_count, sizeof(glm::uvec2));
  dispatch_linear(graph.compute(kName, kernels::photon_splatting_stratify_keys_comp)
                      .read("points", points)
                      .write("keys", keys)
                      .write("point_counts", result.point_counts)
                      .push(params),
                  params.point_count);
  const auto bits = static_cast<std::uint32_t>(std::bit_width(params.no_cell));
  result.sorted = record_sort(graph, kName, keys, params.point_count, bits);
  return result;
}

// Where bundles begin: uint a bundle. Sets the number of splats.
BufferHandle find_bundles(FrameGraph& graph, const SortedPoints& points, PhotonSplats& splats) {
  const glsl::StratifyParams& params = points.params;
  BufferHandle merged = graph.create_buffer("merged cells", params.point_count, sizeof(std::uint32_t));
  graph.fill(kName, merged, 0);
  dispatch_linear(graph.compute(kName, kernels::photon_splatting_stratify_merge_comp)
                      .read("sorted", points.sorted)
                      .read("point_counts", points.point_counts)
                      .write("merged", merged)
                      .push(params),
                  params.point_count);
  BufferHandle flags = graph.create_buffer("light point flags", params.point_count, sizeof(std::uint32_t));
  dispatch_linear(graph.compute(kName, kernels::photon_splatting_stratify_heads_comp)
                      .read("sorted", points.sorted)
                      .read("point_counts", points.point_counts)
                      .read("merged", merged)
                      .write("flags", flags)
                      .push(params),
                  params.point_count);
  const PrefixSums sums = record_prefix_sums(graph, kName, flags, params.point_count);
  BufferHandle begins = graph.create_buffer("bundle begins", params.capacity, sizeof(std::uint32_t));
  dispatch_linear(graph.compute(kName, kernels::photon_splatting_stratify_begin_comp)
                      .read("flags", flags)
                      .read("sums", sums.sums)
                      .read("blocks", sums.blocks)
                      .write("begins", begins)
                      .write("splat_counts", splats.counts)
                      .push(params),
                  params.point_count);
  return begins;
}

}  // namespace

void record_bundles(FrameGraph& graph, WorldFrame& world, const SizedLightPaths& paths,
                    const StratifySettings& settings, PhotonSplats& splats) {
  const glsl::PhotonParams& params = splats.params;
  const auto bits = static_cast<std::uint32_t>(std::bit_width(settings.cells - 1));
  const SortedPoints points = sort_points(graph, paths.points,
                                          {.grid = fit_voxel_grid(world.grid_bounds, settings.cells),
                                           .point_count = params.paths * params.bounces * params.rounds,
                                           .no_cell = 1u << (3 * bits),
                                           .threshold = std::max(settings.threshold, 1u),
                                           .levels = std::min({settings.levels, bits, glsl::kMostMergeLevels}),
                                           .capacity = params.capacity,
                                           .map_side = params.map_side});
  const BufferHandle begins = find_bundles(graph, points, splats);
  trace_compute(graph, "photon splatting: photons", kernels::photon_splatting_bundle_make_comp, world)
      .read("points", paths.points)
      .read("areas", paths.areas)
      .read("sorted", points.sorted)
      .read("begins", begins)
      .read("point_counts", points.point_counts)
      .read("splat_counts", splats.counts)
      .read("sobol_matrices", upload_sobol_matrices(graph))
      .write("splats", splats.splats)
      .write("starts", splats.starts)
      .constant("kNearestToMean", settings.representative == Representative::kNearestToMean ? 1 : 0)
      .push(params)
      .dispatch_indirect(splats.counts, kSplatGroupsOffset);
}

}  // namespace lightwell
