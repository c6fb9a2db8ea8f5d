#include "passes/light_clusters/light_clusters.h"

#include <string>

#include "graph/linear_dispatch.h"
#include "kernels/passes/light_clusters/clusters_build.comp.h"
#include "kernels/passes/light_clusters/clusters_flags.comp.h"
#include "kernels/passes/light_clusters/clusters_keys.comp.h"
#include "kernels/passes/light_clusters/clusters_sort_points.comp.h"
#include "lightwell/error.h"
#include "passes/light_clusters/light_clusters_params.h"
#include "passes/sort/sort.h"
#include "passes/voxel_grid/voxel_grid.h"
#include "shaders/light_point.h"

namespace lightwell {

LightClusters record_light_clusters(FrameGraph& graph, BufferHandle points, std::uint32_t count, const Bounds& bounds) {
  LW_ASSERT(count >= 1 && count <= glsl::kMostLightPoints, std::to_string(count) + " light points");
  constexpr std::uint32_t kWord = sizeof(std::uint32_t);
  const glsl::ClusterParams params{fit_voxel_grid(bounds, glsl::kClusterCells), count};
  LightClusters result;
  result.point_count = count;
  result.order = graph.create_buffer("light cluster keys", count, sizeof(glm::uvec2));
  result.points = graph.create_buffer("clustered light points", count, sizeof(glsl::LightPoint));
  result.running = graph.create_buffer("light cluster sums", count, sizeof(float));
  result.clusters = graph.create_buffer("light clusters", glsl::kMostClusters, sizeof(glsl::LightCluster));
  result.counts = graph.create_buffer("light cluster counts", glsl::kClusterCountWords, kWord);

  dispatch_linear(graph.compute("light clusters: keys", kernels::light_clusters_clusters_keys_comp)
                      .read("points", points)
                      .write("keys", result.order)
                      .push(params),
                  count);
  result.order = record_sort(graph, "light clusters: sort", result.order, count, glsl::kClusterKeyBits);
  graph.fill("light clusters: clear", result.counts, 0);
  dispatch_linear(graph.compute("light clusters: sort", kernels::light_clusters_clusters_sort_points_comp)
                      .read("keys", result.order)
                      .read("points", points)
                      .write("sorted_points", result.points)
                      .write("counts", result.counts)
                      .push(params),
                  count);
  BufferHandle flags = graph.create_buffer("light cluster flags", count, kWord);
  dispatch_linear(graph.compute("light clusters: build", kernels::light_clusters_clusters_flags_comp)
                      .read("keys", result.order)
                      .read("counts", result.counts)
                      .write("flags", flags)
                      .push(params),
                  count);
  const PrefixSums ranks = record_prefix_sums(graph, "light clusters: build", flags, count);
  dispatch_linear(graph.compute("light clusters: build", kernels::light_clusters_clusters_build_comp)
                      .read("keys", result.order)
                      .read("counts", result.counts)
                      .read("flags", flags)
                      .read("ranks", ranks.sums)
                      .read("blocks", ranks.blocks)
                      .read("points", result.points)
                      .write("running", result.running)
                      .write("clusters", result.clusters)
                      .push(params),
                  count);
  return result;
}

}  // namespace lightwell
