#include "techniques/photon_splatting/photons.h"

#include <vector>

#include "graph/linear_dispatch.h"
#include "kernels/techniques/photon_splatting/photons_add.comp.h"
#include "kernels/techniques/photon_splatting/photons_count.comp.h"
#include "kernels/techniques/photon_splatting/splat_make.comp.h"
#include "passes/light_paths/path_sequence.h"
#include "passes/sort/sort.h"
#include "techniques/photon_splatting/splat_types.h"

namespace lightwell {

PhotonSplats begin_splats(FrameGraph& graph, const glsl::PhotonParams& params, bool guided) {
  PhotonSplats splats{.params = params};
  splats.splats = graph.create_buffer("splats", params.capacity, sizeof(glsl::StoredSplat));
  splats.starts = graph.create_buffer("photon starts", params.capacity, sizeof(glsl::PhotonStart));
  splats.counts = graph.create_buffer("splat counts", glsl::kSplatCountWords, sizeof(std::uint32_t));
  graph.fill("photon splatting: photons", splats.counts, 0);
  if (guided) splats.strata = graph.create_buffer("photon strata", params.capacity, sizeof(std::uint32_t));
  return splats;
}

BufferHandle begin_point_counts(FrameGraph& graph) {
  BufferHandle counts = graph.create_buffer("light point counts", glsl::kPointCountWords, sizeof(std::uint32_t));
  graph.fill("photon splatting: photons", counts, 0);
  return counts;
}

BufferHandle upload_sobol_matrices(FrameGraph& graph) {
  return graph.upload<std::uint32_t>("sobol matrices", make_sobol_matrices());
}

void record_photons(FrameGraph& graph, WorldFrame& world, const SizedLightPaths& paths, PhotonSplats& splats) {
  constexpr std::string_view kName = "photon splatting: photons";
  const glsl::PhotonParams& params = splats.params;
  const std::uint32_t count = params.paths * params.bounces;
  BufferHandle point_counts = begin_point_counts(graph);
  BufferHandle flags = graph.create_buffer("light point flags", count, sizeof(std::uint32_t));
  dispatch_linear(graph.compute(kName, kernels::photon_splatting_photons_count_comp)
                      .read("points", paths.points)
                      .write("flags", flags)
                      .write("point_counts", point_counts)
                      .push(params),
                  count);
  const PrefixSums sums = record_prefix_sums(graph, kName, flags, count);
  const bool guided = static_cast<bool>(splats.strata);
  BufferHandle path_strata = paths.strata;
  BufferHandle splat_strata = splats.strata;
  if (!guided) {
    path_strata = graph.upload<std::uint32_t>("no strata", std::vector<std::uint32_t>(1, 0));
    splat_strata = graph.create_buffer("no strata", 1, sizeof(std::uint32_t));
  }
  dispatch_linear(trace_compute(graph, kName, kernels::photon_splatting_splat_make_comp, world)
                      .read("points", paths.points)
                      .read("areas", paths.areas)
                      .read("sums", sums.sums)
                      .read("blocks", sums.blocks)
                      .read("point_counts", point_counts)
                      .read("splat_counts", splats.counts)
                      .read("sobol_matrices", upload_sobol_matrices(graph))
                      .write("splats", splats.splats)
                      .write("starts", splats.starts)
                      .read("path_strata", path_strata)
                      .write("splat_strata", splat_strata)
                      .constant("kGuided", guided ? 1 : 0)
                      .push(params),
                  count);
  if (guided) splats.strata = splat_strata;
  graph.compute(kName, kernels::photon_splatting_photons_add_comp)
      .read("point_counts", point_counts)
      .write("splat_counts", splats.counts)
      .push(params)
      .dispatch(1);
}

}  // namespace lightwell
