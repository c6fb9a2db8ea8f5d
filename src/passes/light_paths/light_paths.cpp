#include "passes/light_paths/light_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "graph/linear_dispatch.h"
#include "kernels/passes/light_paths/light_paths_bounce.comp.h"
#include "kernels/passes/light_paths/light_paths_maps.comp.h"
#include "kernels/passes/light_paths/light_paths_rays.comp.h"
#include "kernels/passes/light_paths/light_paths_sources.comp.h"
#include "lightwell/error.h"
#include "passes/light_paths/light_path_guide.h"
#include "passes/light_paths/light_paths_params.h"
#include "passes/light_paths/path_sequence.h"
#include "shaders/light_point.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kMostBounces = 8;

// Bases of the Halton sequence from the sixth dimension on: the start takes 2, 3, 5, 7 and 11 (sequence.glsl).
constexpr std::array<std::uint32_t, 3 * (kMostBounces - 1)> kBases{13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53,
                                                                   59, 61, 67, 71, 73, 79, 83, 89, 97, 101};

std::uint32_t environment_kind(const GpuEnvironment& environment, LightKinds kinds) {
  if (environment.is_black() || !has(kinds, LightKinds::kEnvironment)) return glsl::kSkyBlack;
  return environment.constant_radiance() ? glsl::kSkyConstant : glsl::kSkyMap;
}

// What the kernels share.
struct Paths {
  glsl::LightPathsParams params;
  std::uint32_t environment = glsl::kSkyBlack;
  std::uint32_t sequence = glsl::kSequenceSobol;
  BufferHandle map_powers;  // float a light: -1 without a map
  BufferHandle sources;
  BufferHandle points;
  BufferHandle survivals;
  bool sized = false;  // their areas are wanted
  BufferHandle areas;
  BufferHandle sobol_matrices;
  bool guided = false;
  LightPathGuide guide;
  BufferHandle strata;
};

// The scene's bounds with room for surfaces that lie in them.
void set_bounds(const WorldFrame& world, glsl::LightPathsParams& params) {
  constexpr float kRoom = 1e-3f;
  const Bounds bounds = finite_bounds(world);
  const float farthest = std::max(glm::length(bounds.minimum), glm::length(bounds.maximum));
  const float room = kRoom * glm::length(bounds.maximum - bounds.minimum) + 1e-6f * farthest;
  params.low = bounds.minimum - room;
  params.high = bounds.maximum + room;
}

void set_aims(const std::vector<FocusBall>& aims, glsl::LightPathsParams& params) {
  if (aims.empty()) return;
  // And balls between them, so that the flux of paths rises by steps of four at most.
  params.aim_count = static_cast<std::uint32_t>(2 * aims.size() - 1);
  params.aim_radius = aims[0].radius;
  params.aim_ratio = aims.size() > 1 ? std::sqrt(aims[1].radius / aims[0].radius) : 1.0f;
  params.focus = aims[0].center;
}

void record_sources(FrameGraph& graph, WorldFrame& world, Paths& paths) {
  const EmitterTable::Frame& emitters = world.emitters();
  const BufferHandle table = world.environment_table();
  paths.sources = graph.create_buffer("light path sources", paths.params.light_count + 3, sizeof(float));
  graph.compute("light paths: sources", kernels::light_paths_light_paths_sources_comp)
      .read("lights", world.lights.lights)
      .read("map_powers", paths.map_powers)
      .read("groups", emitters.groups)
      .read("environment_table", table)
      .read("environment", world.environment)
      .write("sources", paths.sources)
      .read("guide", paths.guide.table)
      .constant("kGuided", paths.guided ? 1 : 0)
      .constant("kEnvironment", paths.environment)
      .push(paths.params)
      .dispatch(1);
}

void start_from_maps(FrameGraph& graph, const WorldFrame& world, const ReflectiveShadowMaps::Frame& maps,
                     bool no_others, Paths& paths) {
  ComputePass& pass = graph.compute("light paths: from maps", kernels::light_paths_light_paths_maps_comp)
                          .read("lights", world.lights.lights)
                          .read("map_powers", paths.map_powers)
                          .read("sources", paths.sources)
                          .read("views", maps.views)
                          .read("position", maps.position)
                          .read("normal", maps.normal)
                          .read("flux", maps.flux)
                          .read("luminances", maps.luminances)
                          .write("points", paths.points)
                          .write("survivals", paths.survivals)
                          .write("areas", paths.areas)
                          .constant("kAreas", paths.sized ? 1 : 0)
                          .read("sobol_matrices", paths.sobol_matrices)
                          .constant("kSequence", paths.sequence)
                          .constant("kNoOthers", no_others ? 1 : 0)
                          .push(paths.params);
  dispatch_linear(pass, paths.params.path_count);
}

void start_as_rays(FrameGraph& graph, WorldFrame& world, Paths& paths) {
  const EmitterTable::Frame& emitters = world.emitters();
  const BufferHandle table = world.environment_table();
  ComputePass& pass = trace_compute(graph, "light paths: as rays", kernels::light_paths_light_paths_rays_comp, world)
                          .read("lights", world.lights.lights)
                          .read("map_powers", paths.map_powers)
                          .read("sources", paths.sources)
                          .read("environment", world.environment)
                          .read("emitters", emitters.emitters)
                          .read("groups", emitters.groups)
                          .read("environment_table", table)
                          .write("points", paths.points)
                          .write("survivals", paths.survivals)
                          .write("areas", paths.areas)
                          .constant("kAreas", paths.sized ? 1 : 0)
                          .read("sobol_matrices", paths.sobol_matrices)
                          .constant("kSequence", paths.sequence)
                          .constant("kEnvironment", paths.environment)
                          .constant("kEmitters", paths.params.emitter_count > 0 ? 1 : 0)
                          .constant("kEmittersLookUp", emitters.look_up ? 1 : 0)
                          .read("guide", paths.guide.table)
                          .write("strata", paths.strata)
                          .write("stratum_counts", paths.guide.counts)
                          .constant("kGuided", paths.guided ? 1 : 0)
                          .push(paths.params);
  dispatch_linear(pass, paths.params.path_count);
}

void bounce(FrameGraph& graph, WorldFrame& world, std::uint32_t surface, Paths& paths) {
  const std::uint32_t* bases = &kBases[3 * (surface - 2)];
  paths.params.bounce = surface;
  paths.params.bases = {bases[0], bases[1], bases[2]};
  ComputePass& pass = trace_compute(graph, "light paths: bounce", kernels::light_paths_light_paths_bounce_comp, world)
                          .write("points", paths.points)
                          .write("survivals", paths.survivals)
                          .write("areas", paths.areas)
                          .constant("kAreas", paths.sized ? 1 : 0)
                          .read("sobol_matrices", paths.sobol_matrices)
                          .constant("kSequence", paths.sequence)
                          .push(paths.params);
  dispatch_linear(pass, paths.params.path_count);
}

void set_guide(FrameGraph& graph, const LightPathGuide* guide, Paths& paths) {
  paths.guided = guide != nullptr;
  paths.strata =
      graph.create_buffer("light path strata", paths.guided ? paths.params.path_count : 1, sizeof(std::uint32_t));
  if (guide != nullptr) {
    paths.guide = *guide;
    return;
  }
  paths.guide.table = graph.upload<float>("no guide", std::vector<float>(1, 0.0f));
  paths.guide.counts = graph.create_buffer("no guide", 1, sizeof(glm::uvec2));
}

SizedLightPaths record_paths(FrameGraph& graph, WorldFrame& world, const ReflectiveShadowMaps::Frame& maps,
                             const LightPathSettings& settings, std::uint32_t round, bool sized,
                             LightPathGuide* guide = nullptr) {
  const std::uint32_t path_count = std::clamp(settings.paths, 16u, 65536u);
  const std::uint32_t bounces = std::clamp(settings.bounces, 1u, kMostBounces);
  Paths paths;
  paths.sized = sized;
  paths.params = {.path_count = path_count,
                  .first_path = round * path_count,
                  .table_size = world.gpu_environment().table_size(),
                  .light_count = has(settings.kinds, LightKinds::kLights) ? world.lights.count : 0,
                  .emitter_count = has(settings.kinds, LightKinds::kEmitters) ? world.scene.emissive_triangle_count : 0,
                  .bounce = 1,
                  .top_level = maps.top_level};
  set_bounds(world, paths.params);
  set_aims(settings.aims.value_or(world.focus_balls), paths.params);
  paths.environment = environment_kind(world.gpu_environment(), settings.kinds);
  paths.sequence = settings.sequence == PathSequence::kHalton ? glsl::kSequenceHalton : glsl::kSequenceSobol;
  paths.points = graph.create_buffer("light points", std::uint64_t{path_count} * bounces, sizeof(glsl::LightPoint));
  paths.areas =
      graph.create_buffer("light point areas", sized ? std::uint64_t{path_count} * bounces : 1, sizeof(float));
  const bool from_maps = starts_from_maps(world, settings) && maps;
  const std::uint32_t mapped = from_maps ? maps.light_count : 0;
  LW_ASSERT(guide == nullptr || !from_maps, "guided paths start as rays");
  const bool as_rays =
      paths.params.light_count > mapped || paths.params.emitter_count > 0 || paths.environment != glsl::kSkyBlack;
  if (!from_maps && !as_rays) {
    graph.fill("light paths: none", paths.points, 0);
    if (sized) graph.fill("light paths: none", paths.areas, 0);
    BufferHandle strata;
    if (guide != nullptr) {
      strata = graph.create_buffer("light path strata", path_count, sizeof(std::uint32_t));
      graph.fill("light paths: none", strata, glsl::kNoStratum);
    }
    return {paths.points, paths.areas, strata};
  }
  set_guide(graph, guide, paths);
  paths.survivals = graph.create_buffer("light path survivals", path_count, sizeof(float));
  paths.sobol_matrices = graph.upload<std::uint32_t>("sobol matrices", make_sobol_matrices());
  paths.map_powers =
      from_maps ? maps.powers : graph.upload<float>("light powers", std::vector<float>(world.lights.count, -1.0f));
  record_sources(graph, world, paths);
  if (from_maps) start_from_maps(graph, world, maps, !as_rays, paths);
  if (as_rays) start_as_rays(graph, world, paths);
  for (std::uint32_t surface = 2; surface <= bounces; ++surface) bounce(graph, world, surface, paths);
  if (guide != nullptr) *guide = paths.guide;
  return {paths.points, paths.areas, paths.strata};
}

}  // namespace

bool starts_from_maps(const WorldFrame& world, const LightPathSettings& settings) {
  return has(settings.kinds, LightKinds::kLights) && world.lights.count > 0 &&
         world.lights.count <= settings.rsm_lights;
}

BufferHandle record_light_paths(FrameGraph& graph, WorldFrame& world, const ReflectiveShadowMaps::Frame& maps,
                                const LightPathSettings& settings, std::uint32_t round) {
  return record_paths(graph, world, maps, settings, round, false).points;
}

SizedLightPaths record_sized_light_paths(FrameGraph& graph, WorldFrame& world, const ReflectiveShadowMaps::Frame& maps,
                                         const LightPathSettings& settings, std::uint32_t round,
                                         LightPathGuide* guide) {
  return record_paths(graph, world, maps, settings, round, true, guide);
}

}  // namespace lightwell
