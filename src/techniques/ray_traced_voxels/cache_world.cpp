#include "techniques/ray_traced_voxels/cache_world.h"

#include <algorithm>
#include <array>

#include "graph/linear_dispatch.h"
#include "kernels/techniques/ray_traced_voxels/cache_carry.comp.h"
#include "kernels/techniques/ray_traced_voxels/cache_deposit.comp.h"
#include "kernels/techniques/ray_traced_voxels/cache_gather.comp.h"
#include "kernels/techniques/ray_traced_voxels/cache_list.comp.h"
#include "kernels/techniques/ray_traced_voxels/cache_points.comp.h"
#include "kernels/techniques/ray_traced_voxels/cache_resolve.comp.h"
#include "kernels/techniques/ray_traced_voxels/cache_solve.comp.h"
#include "passes/light_paths/light_paths.h"

namespace lightwell {
namespace {

constexpr std::array<std::string_view, 4> kResolutions{"32", "64", "128", "256"};
constexpr std::uint32_t kSmallestResolution = 32;

// What a face's mean counts for at most where light or geometry changes: it lags by as many.
constexpr float kMostDirectInChange = 0.0f;    // samples: those of the last frame are all that counts
constexpr float kMostGatheredInChange = 4.0f;  // frames

// Of the dispatch over all faces, in their counts.
constexpr std::uint64_t kFaceGroupsOffset = glsl::kFaceGroups * sizeof(std::uint32_t);

// Samples of direct light in a frame that the history's length is counted in.
constexpr float kSamplesAFrame = 16.0f;

// That fit into the memory.
std::uint32_t most_faces(const LightCacheOptions& options) {
  const std::uint64_t bytes = sizeof(glsl::FaceLight) + glsl::kInjectWords * sizeof(std::uint32_t) +
                              (2 + glsl::kShownWords) * sizeof(glm::vec4) + 8 * sizeof(std::uint32_t) +
                              static_cast<std::uint64_t>(options.links) * sizeof(glm::uvec2);
  return static_cast<std::uint32_t>((static_cast<std::uint64_t>(options.memory) << 20) / bytes);
}

// Links a face: as many as asked for, as long as all fit into the range that every device can bind (128 MiB).
std::uint32_t choose_links(std::uint32_t capacity, std::uint32_t asked) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 27;
  return std::clamp(static_cast<std::uint32_t>(kMostBytes / (sizeof(glm::uvec2) * capacity)), 1u, asked);
}

}  // namespace

void LightCacheWorld::describe(OptionVisitor& visitor, LightCacheOptions& options) {
  constexpr OptionScope kWorld = OptionScope::kWorld;
  visitor.visit(
      {"resolution", "Voxels along the longest axis of the scene, and along each side of every level within it.",
       "voxels", "rays and memory with its square", kWorld},
      options.resolution, kResolutions);
  visitor.visit({"finest-cell",
                 "Levels of voxels half as large are added about the camera until they are no larger than this; none "
                 "where twice this is enough. 0: one level.",
                 "m", "time and memory with the number of levels", kWorld},
                options.finest_cell, 0.0f, 1e6f);
  visitor.visit(
      {"memory", "For the light of voxels, at most; where it ends, the coarser levels answer.", "MiB", "", kWorld},
      options.memory, 1, 65536);
  constexpr std::array<std::string_view, 2> kInjections{"camera", "light"};
  int inject = static_cast<int>(options.inject);
  visitor.visit({"inject",
                 "How direct light gets into the voxels: by shadow rays from where the camera's rays end, or by rays "
                 "from the lights.",
                 "", "", kWorld},
                inject, kInjections);
  options.inject = static_cast<LightInjection>(inject);
  visitor.visit(
      {"light-paths", "Rays from the lights in each frame, with --inject light.", "", "time in proportion", kWorld},
      options.light_paths, 16, 65536);
  visitor.visit({"links", "Rays that a voxel's side remembers, as far as they fit into 128 MiB.", "",
                 "memory, time, and frames until what moved is forgotten; less noise", kWorld},
                options.links, 1, 256);
  visitor.visit({"cache-history", "Frames that a voxel's direct light counts at most.", "", "", kWorld},
                options.history, 1, 4096);
}

// The faces' state, where this frame's faces are.
void LightCacheWorld::find_light(FrameGraph& graph, const WorldFrame& world) {
  const std::uint32_t capacity = faces_.capacity;
  const std::uint64_t words = std::uint64_t{capacity} * glsl::kInjectWords;
  bool light_fresh = false;
  face_light_ = graph.history_buffer("face light", capacity, sizeof(glsl::FaceLight), light_fresh);
  bool votes_fresh = false;
  votes_ = graph.history_buffer("face votes", capacity, sizeof(std::uint32_t), votes_fresh);
  const std::uint64_t link_count = std::uint64_t{capacity} * params_.link_count;
  bool links_fresh = false;
  links_ = graph.history_buffer("face links", link_count, sizeof(glm::uvec2), links_fresh);
  bool injected_fresh = false;
  injected_ = graph.history_buffer("face injections", words, sizeof(std::uint32_t), injected_fresh);
  if (light_fresh || votes_fresh || injected_fresh || links_fresh || faces_.fresh || world.is_cut) {
    constexpr std::string_view kName = "ray-traced voxels: clear";
    graph.fill(kName, face_light_, 0);
    graph.fill(kName, votes_, 0);
    graph.fill(kName, injected_, 0);
    return;
  }
  if (!faces_.moved) return;
  constexpr std::string_view kName = "ray-traced voxels: carry";
  BufferHandle old_light = graph.create_buffer("old face light", capacity, sizeof(glsl::FaceLight));
  BufferHandle old_votes = graph.create_buffer("old face votes", capacity, sizeof(std::uint32_t));
  BufferHandle old_injected = graph.create_buffer("old face injections", words, sizeof(std::uint32_t));
  BufferHandle old_links = graph.create_buffer("old face links", link_count, sizeof(glm::uvec2));
  graph.copy(kName, links_, old_links, link_count * sizeof(glm::uvec2));
  graph.copy(kName, face_light_, old_light, std::uint64_t{capacity} * sizeof(glsl::FaceLight));
  graph.copy(kName, votes_, old_votes, std::uint64_t{capacity} * sizeof(std::uint32_t));
  graph.copy(kName, injected_, old_injected, words * sizeof(std::uint32_t));
  graph.compute(kName, kernels::ray_traced_voxels_cache_carry_comp)
      .read("counts", faces_.counts)
      .read("before", faces_.before)
      .read("old_light", old_light)
      .read("old_votes", old_votes)
      .read("old_injected", old_injected)
      .write("face_light", face_light_)
      .write("votes", votes_)
      .write("injected", injected_)
      .read("old_links", old_links)
      .write("links", links_)
      .push(params_)
      .dispatch_indirect(faces_.counts, kFaceGroupsOffset);
}

void LightCacheWorld::record_deposit(FrameGraph& graph, WorldFrame& world) {
  const LightPathSettings settings{
      .paths = static_cast<std::uint32_t>(options_.light_paths), .bounces = 1, .rsm_lights = 0};
  const BufferHandle points = record_light_paths(graph, world, {}, settings, static_cast<std::uint32_t>(world.index));
  glsl::CacheParams params = params_;
  params.count = settings.paths;
  dispatch_linear(graph.compute("ray-traced voxels: inject", kernels::ray_traced_voxels_cache_deposit_comp)
                      .read("points", points)
                      .read("face_table", faces_.table)
                      .read("areas", faces_.areas)
                      .write("injected", injected_)
                      .push(params),
                  settings.paths);
}

ComputePass& LightCacheWorld::ask_cache(ComputePass& pass) {
  return pass.read("face_table", faces_.table).read("indirect", indirect_).write("votes", votes_);
}

ComputePass& LightCacheWorld::inject_cache(ComputePass& pass) {
  return ask_cache(pass).read("shown", shown_).write("injected", injected_);
}

void LightCacheWorld::record_gather(FrameGraph& graph, WorldFrame& world) {
  BufferHandle list =
      graph.create_buffer("gathering faces", glsl::kListHeader + std::uint64_t{faces_.capacity}, sizeof(std::uint32_t));
  graph.fill("ray-traced voxels: resolve", list, 0);
  shown_ =
      graph.create_buffer("shown face light", std::uint64_t{faces_.capacity} * glsl::kShownWords, sizeof(glm::vec4));
  BufferHandle last_indirect = graph.create_buffer("last face indirect", faces_.capacity, sizeof(glm::vec4));
  indirect_ = graph.create_buffer("face indirect", faces_.capacity, sizeof(glm::vec4));
  graph.compute("ray-traced voxels: resolve", kernels::ray_traced_voxels_cache_resolve_comp)
      .read("counts", faces_.counts)
      .write("face_light", face_light_)
      .write("votes", votes_)
      .write("injected", injected_)
      .write("shown", shown_)
      .write("indirect", last_indirect)
      .write("solved", indirect_)
      .write("list", list)
      .constant("kFromLights", from_lights() ? 1 : 0)
      .push(params_)
      .dispatch_indirect(faces_.counts, kFaceGroupsOffset);
  graph.compute("ray-traced voxels: resolve", kernels::ray_traced_voxels_cache_list_comp)
      .write("list", list)
      .push(params_)
      .dispatch(1);

  sources_ = find_direct_sources(world);
  params_.table_size = sources_.table_size;
  params_.emitter_count = sources_.emitter_count;
  params_.light_count = sources_.light_count;
  ComputePass& pass =
      trace_compute(graph, "ray-traced voxels: gather", kernels::ray_traced_voxels_cache_gather_comp, world);
  read_direct_sources(pass, sources_)
      .read("face_table", faces_.table)
      .write("votes", votes_)
      .write("injected", injected_)
      .write("links", links_)
      .write("face_light", face_light_)
      .read("keys", faces_.keys)
      .read("list", list)
      .constant("kFromLights", from_lights() ? 1 : 0)
      .push(params_)
      .dispatch_indirect(list);
  graph.compute("ray-traced voxels: solve", kernels::ray_traced_voxels_cache_solve_comp)
      .read("list", list)
      .read("links", links_)
      .read("face_table", faces_.table)
      .read("shown", shown_)
      .read("indirect", last_indirect)
      .write("face_light", face_light_)
      .write("solved", indirect_)
      .constant("kFromLights", from_lights() ? 1 : 0)
      .push(params_)
      .dispatch_indirect(list);
}

void LightCacheWorld::record_world(FrameGraph& graph, WorldFrame& world) {
  faces_ = record_voxel_faces(
      graph, world,
      {.levels = {.resolution = kSmallestResolution << options_.resolution, .finest_cell = options_.finest_cell},
       .areas = from_lights(),
       .capacity = most_faces(options_)},
      face_memory_);
  const bool changed = revisions_ && !(*revisions_ == world.revisions);
  const auto history = static_cast<float>(options_.history);
  params_ = {.levels = faces_.levels,
             .last_center = last_center_,
             .frame = static_cast<std::uint32_t>(world.index),
             .capacity = faces_.capacity,
             .most_direct = changed ? kMostDirectInChange : history * (from_lights() ? 1.0f : kSamplesAFrame),
             .most_gathered = changed ? kMostGatheredInChange : history,
             .link_count = choose_links(faces_.capacity, static_cast<std::uint32_t>(options_.links))};

  find_light(graph, world);
  if (from_lights()) record_deposit(graph, world);
  record_gather(graph, world);
  graph.on_recorded([this, revisions = world.revisions, center = faces_.levels.center] {
    revisions_ = revisions;
    last_center_ = center;
  });
}

BufferHandle LightCacheWorld::record_points(FrameGraph& graph, WorldFrame&, const Points& points) {
  BufferHandle irradiance = graph.create_buffer("point irradiance", points.count, sizeof(glm::vec4));
  glsl::CacheParams params = params_;
  params.count = points.count;
  ComputePass& pass = graph.compute("ray-traced voxels: points", kernels::ray_traced_voxels_cache_points_comp);
  ask_cache(pass).read("points", points.points).write("irradiance", irradiance).push(params);
  dispatch_linear(pass, points.count);
  return irradiance;
}

}  // namespace lightwell
