#include "techniques/light_volume/surfel_passes.h"

#include <algorithm>
#include <utility>

#include "graph/linear_dispatch.h"
#include "graph/pages.h"
#include "kernels/techniques/light_volume/surfel_accumulate.comp.h"
#include "kernels/techniques/light_volume/surfel_carry.comp.h"
#include "kernels/techniques/light_volume/surfel_count.comp.h"
#include "kernels/techniques/light_volume/surfel_direct.comp.h"
#include "kernels/techniques/light_volume/surfel_emitter_rays.comp.h"
#include "kernels/techniques/light_volume/surfel_emitters_find.comp.h"
#include "kernels/techniques/light_volume/surfel_filter.comp.h"
#include "kernels/techniques/light_volume/surfel_gather.comp.h"
#include "kernels/techniques/light_volume/surfel_lookup.comp.h"
#include "kernels/techniques/light_volume/surfel_neighbours.comp.h"
#include "kernels/techniques/light_volume/surfel_points.comp.h"
#include "kernels/techniques/light_volume/surfel_resolve.comp.h"
#include "kernels/techniques/light_volume/surfel_store.comp.h"
#include "kernels/techniques/light_volume/surfel_summary.comp.h"
#include "kernels/techniques/light_volume/surfel_trace.comp.h"
#include "kernels/techniques/light_volume/surfel_view.comp.h"
#include "passes/voxelize/voxelize.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kWord = sizeof(std::uint32_t);

std::uint32_t count_bricks(const VoxelGrid& grid) {
  const glm::uvec3 bricks = (grid.resolution + 3u) / 4u;
  return bricks.x * bricks.y * bricks.z;
}

// One invocation for every surfel in use.
void dispatch_surfels(ComputePass& pass, const SurfelVolume& volume) {
  pass.read("counts", volume.counts).dispatch_indirect(volume.counts, glsl::kCountGroups * kWord);
}

BufferHandle keep_copy(FrameGraph& graph, BufferHandle source) {
  const BufferDesc desc = graph.desc(source);
  BufferHandle copy = graph.create_buffer("surfels: before", desc.size / desc.stride, desc.stride);
  graph.copy("surfels: keep", source, copy, desc.size);
  return copy;
}

// Slots for the surfels of every cell that the triangles meet.
void record_slots(FrameGraph& graph, SurfelVolume& volume, const VoxelizedTriangles& voxels,
                  const glsl::SurfelParams& params) {
  graph.fill("surfels: clear", volume.counts, 0);
  graph.compute("surfels: slots", kernels::light_volume_surfel_store_comp)
      .read("cells", voxels.cells)
      .write("counts", volume.counts)
      .write("table", volume.table)
      .write("bricks", volume.bricks)
      .write("surfels", volume.surfels)
      .push(params)
      .dispatch_threads(count_bricks(params.grid));
  graph.compute("surfels: slots", kernels::light_volume_surfel_count_comp)
      .write("counts", volume.counts)
      .push(params)
      .dispatch(1);
}

// What the surfels are made of.
void record_shapes(FrameGraph& graph, SurfelVolume& volume, const GpuScene::Frame& scene,
                   const VoxelizedTriangles& voxels, const glsl::SurfelParams& params) {
  BufferHandle sums =
      graph.create_buffer("surfel sums", std::uint64_t{params.capacity} * glsl::kSumWords, sizeof(std::uint32_t));
  graph.fill("surfels: clear", sums, 0);
  visit_triangles(graph, "surfels: accumulate", kernels::light_volume_surfel_accumulate_comp, scene, voxels.tiles,
                  [&](ComputePass& pass) {
                    pass.read("cells", voxels.cells).read("table", volume.table).write("sums", sums).push(params);
                  });
  ComputePass& resolve = graph.compute("surfels: resolve", kernels::light_volume_surfel_resolve_comp)
                             .read("sums", sums)
                             .read("cells", voxels.cells)
                             .write("table", volume.table)
                             .write("surfels", volume.surfels)
                             .push(params);
  dispatch_surfels(resolve, volume);
}

// The list of those that emit.
void record_emitters(FrameGraph& graph, SurfelVolume& volume, const glsl::SurfelParams& params) {
  const std::uint32_t bricks = count_bricks(params.grid);
  BufferHandle brick_sums = graph.create_buffer("surfel emitters of bricks", bricks, sizeof(glsl::SurfelEmitter));
  for (const std::uint32_t stage : {0u, 1u, 2u}) {
    graph.compute("surfels: emitters", kernels::light_volume_surfel_emitters_find_comp)
        .constant("kStage", stage)
        .write("counts", volume.counts)
        .read("table", volume.table)
        .read("bricks", volume.bricks)
        .read("surfels", volume.surfels)
        .write("brick_sums", brick_sums)
        .write("emitters", volume.emitters)
        .push(params)
        .dispatch_threads(stage == 1 ? 1 : bricks);
  }
}

}  // namespace

SurfelSizes choose_surfel_sizes(const VoxelGrid& grid, std::uint32_t links) {
  constexpr std::uint64_t kFaces = 48;  // 8 times a closed box with one layer of surfels on either side of its walls
  constexpr std::uint64_t kMostLinks = std::uint64_t{kMaximumPages} << 25;  // words; devices allow pages of 128 MiB
  const std::uint64_t side = std::max({grid.resolution.x, grid.resolution.y, grid.resolution.z});
  const std::uint64_t capacity =
      std::min({6 * side * side * side, kFaces * side * side, std::uint64_t{glsl::kSurfelCapacityLimit} - 1});
  const std::uint64_t most_links = kMostLinks / capacity;
  return {static_cast<std::uint32_t>(capacity),
          static_cast<std::uint32_t>(std::clamp<std::uint64_t>(links, 1, most_links))};
}

SurfelVolume find_surfel_volume(FrameGraph& graph, const VoxelGrid& grid, const SurfelSizes& sizes, bool& fresh) {
  fresh = false;
  const auto find = [&](std::string_view name, std::uint64_t count, std::uint32_t stride) {
    bool is_fresh = false;
    const BufferHandle handle = graph.history_buffer(name, count, stride, is_fresh);
    fresh = fresh || is_fresh;
    return handle;
  };
  return {.counts = find("surfel counts", glsl::kCountWords, kWord),
          .table = find("surfel table", grid.cell_count, kWord),
          .bricks = find("surfel bricks", count_bricks(grid), 2 * kWord),
          .surfels = find("surfels", sizes.capacity, sizeof(glsl::Surfel)),
          .links = find("surfel links", std::uint64_t{sizes.capacity} * sizes.links, kWord),
          .summaries = find("surfel summaries", sizes.capacity, sizeof(glsl::LinkSummary)),
          .emitters = find("surfel emitters", sizes.capacity, sizeof(glsl::SurfelEmitter)),
          .irradiance = find("surfel irradiance", sizes.capacity, sizeof(glm::vec4)),
          .lit = find("lit surfels", sizes.capacity, sizeof(glsl::LitSurfel))};
}

void record_surfels(FrameGraph& graph, SurfelVolume& volume, WorldFrame& world, const glsl::SurfelParams& params,
                    bool keep) {
  SurfelVolume before;
  if (keep) {
    before.table = keep_copy(graph, volume.table);
    before.surfels = keep_copy(graph, volume.surfels);
    before.links = keep_copy(graph, volume.links);
    before.summaries = keep_copy(graph, volume.summaries);
    before.irradiance = keep_copy(graph, volume.irradiance);
  }
  const VoxelizedTriangles voxels = record_voxelize(graph, world.scene, params.grid);
  record_slots(graph, volume, voxels, params);
  record_shapes(graph, volume, world.scene, voxels, params);
  if (world.scene.emission_maximum > 0.0f) record_emitters(graph, volume, params);
  if (!keep) {
    graph.fill("surfels: clear", volume.links, glsl::kLinkNone);
    graph.fill("surfels: clear", volume.summaries, 0);
    graph.fill("surfels: clear", volume.irradiance, 0);
    return;
  }
  ComputePass& carry = graph.compute("surfels: keep", kernels::light_volume_surfel_carry_comp)
                           .read("table", volume.table)
                           .read("surfels", volume.surfels)
                           .read("old_table", before.table)
                           .read("old_surfels", before.surfels)
                           .read("old_links", before.links)
                           .read("old_summaries", before.summaries)
                           .read("old_irradiance", before.irradiance)
                           .write("links", volume.links)
                           .write("summaries", volume.summaries)
                           .write("irradiance", volume.irradiance)
                           .push(params);
  dispatch_surfels(carry, volume);
}

void record_links(FrameGraph& graph, SurfelVolume& volume, WorldFrame& world, const glsl::SurfelParams& params,
                  bool geometry_changed) {
  ComputePass& trace = graph.compute("links: trace", kernels::light_volume_surfel_trace_comp)
                           .read("table", volume.table)
                           .read("bricks", volume.bricks)
                           .read("surfels", volume.surfels)
                           .write("links", volume.links)
                           .push(params);
  dispatch_surfels(trace, volume);
  if (world.scene.emission_maximum > 0.0f) {
    ComputePass& rays = graph.compute("links: emitter rays", kernels::light_volume_surfel_emitter_rays_comp)
                            .read("table", volume.table)
                            .read("bricks", volume.bricks)
                            .read("surfels", volume.surfels)
                            .read("emitters", volume.emitters)
                            .write("summaries", volume.summaries)
                            .push(params);
    dispatch_surfels(rays, volume);
  }
  ComputePass& summary = graph.compute("links: summary", kernels::light_volume_surfel_summary_comp)
                             .read("links", volume.links)
                             .read("surfels", volume.surfels)
                             .read("emitters", volume.emitters)
                             .read("environment", world.environment)
                             .write("summaries", volume.summaries)
                             .push(params);
  dispatch_surfels(summary, volume);
  if (!geometry_changed) return;
  ComputePass& neighbours = graph.compute("links: neighbours", kernels::light_volume_surfel_neighbours_comp)
                                .read("table", volume.table)
                                .read("bricks", volume.bricks)
                                .read("surfels", volume.surfels)
                                .write("summaries", volume.summaries)
                                .push(params);
  dispatch_surfels(neighbours, volume);
}

void record_solution(FrameGraph& graph, SurfelVolume& volume, WorldFrame& world, const glsl::SurfelParams& params,
                     std::uint32_t bounces) {
  const auto create = [&](std::string_view name) {
    return graph.create_buffer(name, params.capacity, sizeof(glm::vec4));
  };
  BufferHandle direct = create("surfel direct");
  BufferHandle radiance = create("surfel radiance");
  BufferHandle next_radiance = create("surfel radiance");
  const ShadowMaps::Frame& shadows = world.shadows();
  ComputePass& light =
      read_lights(graph.compute("solve: direct", kernels::light_volume_surfel_direct_comp), world.lights, shadows)
          .read("surfels", volume.surfels)
          .read("irradiance", volume.irradiance)
          .write("direct", direct)
          .write("radiance", radiance)
          .push(params);
  dispatch_surfels(light, volume);
  for (std::uint32_t bounce = 0; bounce < bounces; ++bounce) {
    ComputePass& gather = graph.compute("solve: gather", kernels::light_volume_surfel_gather_comp)
                              .read("surfels", volume.surfels)
                              .read("links", volume.links)
                              .read("summaries", volume.summaries)
                              .read("direct", direct)
                              .read("radiance", radiance)
                              .write("next_radiance", next_radiance)
                              .write("irradiance", volume.irradiance)
                              .push(params);
    dispatch_surfels(gather, volume);
    std::swap(radiance, next_radiance);
  }
  ComputePass& filter = graph.compute("solve: filter", kernels::light_volume_surfel_filter_comp)
                            .read("table", volume.table)
                            .read("surfels", volume.surfels)
                            .read("summaries", volume.summaries)
                            .read("irradiance", volume.irradiance)
                            .write("lit", volume.lit)
                            .push(params);
  dispatch_surfels(filter, volume);
}

ImageHandle record_surfel_lookup(FrameGraph& graph, const SurfelVolume& volume, const ViewFrame& view_frame,
                                 const glsl::SurfelParams& params) {
  ImageHandle irradiance =
      graph.create_image("indirect irradiance",
                         {.width = params.size.x, .height = params.size.y, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
  graph.compute("lookup", kernels::light_volume_surfel_lookup_comp)
      .read("position", view_frame.gbuffer.position)
      .read("normal", view_frame.gbuffer.normal)
      .read("table", volume.table)
      .read("lit", volume.lit)
      .read("environment", view_frame.world.environment)
      .write("irradiance", irradiance)
      .push(params)
      .dispatch_threads(params.size.x, params.size.y);
  return irradiance;
}

BufferHandle record_surfel_points(FrameGraph& graph, const SurfelVolume& volume, const WorldFrame& world,
                                  const glsl::SurfelParams& params, const Points& points) {
  BufferHandle irradiance = graph.create_buffer("irradiance at points", points.count, sizeof(glm::vec4));
  glsl::SurfelParams point_params = params;
  point_params.size = {points.count, 1};
  dispatch_linear(graph.compute("look up points", kernels::light_volume_surfel_points_comp)
                      .read("points", points.points)
                      .read("table", volume.table)
                      .read("lit", volume.lit)
                      .read("environment", world.environment)
                      .write("irradiance", irradiance)
                      .push(point_params),
                  points.count);
  return irradiance;
}

ImageHandle record_surfel_view(FrameGraph& graph, const SurfelVolume& volume, const ViewFrame& view_frame,
                               const glsl::SurfelParams& params, std::uint32_t kind) {
  ImageHandle view = graph.create_image(
      "surfel view", {.width = params.size.x, .height = params.size.y, .format = VK_FORMAT_R16G16B16A16_SFLOAT});
  graph.compute("surfel view", kernels::light_volume_surfel_view_comp)
      .constant("kView", kind)
      .read("position", view_frame.gbuffer.position)
      .read("normal", view_frame.gbuffer.normal)
      .read("table", volume.table)
      .read("surfels", volume.surfels)
      .read("lit", volume.lit)
      .write("view", view)
      .push(params)
      .dispatch_threads(params.size.x, params.size.y);
  return view;
}

}  // namespace lightwell
