#include "passes/light_clusters/light_sampler.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "kernels/passes/light_clusters/learned_update.comp.h"
#include "kernels/passes/light_clusters/light_choice.comp.h"
#include "kernels/passes/light_clusters/light_tiles.comp.h"
#include "passes/light_clusters/light_sampler_params.h"

namespace lightwell {
namespace {

// Of the scene's diagonal: the side of the cells in which visibility is learned.
constexpr float kLearnedCell = 1.0f / 64.0f;

std::uint32_t divide_up(std::uint32_t a, std::uint32_t b) {
  return (a + b - 1) / b;
}

}  // namespace

Receivers receivers_of(const GBuffer& gbuffer, float clearance) {
  return {gbuffer.position, gbuffer.normal, gbuffer.face, gbuffer.width, gbuffer.height, clearance};
}

LearnedVisibility record_learned_visibility(FrameGraph& graph) {
  bool fresh = false;
  LearnedVisibility result{graph.history_buffer(
      "learned visibility", std::uint64_t{glsl::kLearnedSlots} * glsl::kLearnedWords, sizeof(std::uint32_t), fresh)};
  if (fresh)
    graph.fill("light clusters: learn", result.table, 0);
  else
    graph.compute("light clusters: learn", kernels::light_clusters_learned_update_comp)
        .write("learned", result.table)
        .dispatch_threads(glsl::kLearnedSlots);
  return result;
}

LightTiles record_light_tiles(FrameGraph& graph, const Receivers& receivers, const LightClusters& clusters,
                              const LearnedVisibility& learned, const LightClamp& clamp, const Bounds& bounds) {
  const std::uint32_t columns = divide_up(receivers.width, glsl::kLightTile);
  const std::uint32_t rows = divide_up(receivers.height, glsl::kLightTile);
  const std::uint64_t count = std::uint64_t{columns} * rows;
  const float cell = std::max(kLearnedCell * glm::length(bounds.maximum - bounds.minimum), 1e-9f);
  glsl::LightTileParams params{.size = {receivers.width, receivers.height}, .learned_cell = cell};
  set_clamp(clamp, params);
  LightTiles tiles{graph.create_buffer("light tiles", count, sizeof(glsl::LightTile)),
                   graph.create_buffer("light tile distributions", count * glsl::kMostClusters, sizeof(glm::vec2))};
  graph.compute("light clusters: tiles", kernels::light_clusters_light_tiles_comp)
      .read("position", receivers.position)
      .read("normal", receivers.normal)
      .read("counts", clusters.counts)
      .read("clusters", clusters.clusters)
      .read("learned", learned.table)
      .write("tiles", tiles.tiles)
      .write("distribution", tiles.distribution)
      .push(params)
      .dispatch(columns, rows);
  return tiles;
}

ImageHandle record_light_choice(FrameGraph& graph, const Receivers& receivers, const LightClusters& clusters,
                                const LightTiles& tiles, const LightChoiceSettings& settings) {
  glsl::LightChoiceParams params{.size = {receivers.width, receivers.height},
                                 .candidates = settings.candidates,
                                 .rays = settings.rays,
                                 .first_sample = settings.first_sample,
                                 .sequence = settings.sequence,
                                 .most_bounces = settings.most_bounces};
  set_clamp(settings.clamp, params);
  ImageHandle choice = graph.create_image(
      "light choice",
      {.width = receivers.width, .height = receivers.height * settings.rays, .format = VK_FORMAT_R32G32B32A32_UINT});
  graph.compute("light clusters: choose", kernels::light_clusters_light_choice_comp)
      .read("position", receivers.position)
      .read("normal", receivers.normal)
      .read("counts", clusters.counts)
      .read("clusters", clusters.clusters)
      .read("points", clusters.points)
      .read("order", clusters.order)
      .read("running", clusters.running)
      .read("distribution", tiles.distribution)
      .write("choice", choice)
      .push(params)
      .dispatch_threads(receivers.width, receivers.height);
  return choice;
}

}  // namespace lightwell
