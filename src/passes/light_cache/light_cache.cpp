#include "passes/light_cache/light_cache.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/log.h"
#include "graph/linear_dispatch.h"
#include "kernels/passes/light_cache/cache_carry.comp.h"
#include "kernels/passes/light_cache/cache_deposit.comp.h"
#include "kernels/passes/light_cache/cache_gather.comp.h"
#include "kernels/passes/light_cache/cache_list.comp.h"
#include "kernels/passes/light_cache/cache_look_up.comp.h"
#include "kernels/passes/light_cache/cache_points.comp.h"
#include "kernels/passes/light_cache/cache_resolve.comp.h"
#include "kernels/passes/light_cache/cache_smooth.comp.h"
#include "kernels/passes/light_cache/cache_solve.comp.h"
#include "kernels/passes/light_cache/cache_view.comp.h"
#include "passes/light_paths/light_paths.h"

namespace lightwell {
namespace {

// What a face's mean counts for at most where light or geometry changes: it lags by as many.
constexpr float kMostDirectInChange = 0.0f;    // samples: those of the last frame are all that counts
constexpr float kMostGatheredInChange = 4.0f;  // frames

// Of a picture that rests: until those who are met by rays of those who are met by pixels have been asked for, and
// after that many more bounces nothing changes: 0.95^256 < 1e-5.
constexpr std::uint32_t kFramesUntilAsked = 32;
constexpr std::uint32_t kBouncesUntilSettled = 256;

ImageHandle create_irradiance(FrameGraph& graph, const GBuffer& gbuffer) {
  return graph.create_image(
      "cache irradiance", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
}

// Of the dispatch over all faces, in their counts.
constexpr std::uint64_t kFaceGroupsOffset = glsl::kFaceGroups * sizeof(std::uint32_t);

// Room for faces in use at first, for each page of links: most are on sides that nobody asks for.
constexpr std::uint32_t kFacesOfAPage = 4;

// In which what pixels read takes up what finer or coarser levels say of it, at most.
constexpr std::uint32_t kFramesToAgree = 24;

// Samples of direct light in a frame that the history's length is counted in.
constexpr float kSamplesAFrame = 16.0f;

bool have_windows_moved(const VoxelLevels& last, const VoxelLevels& now) {
  if (last.count != now.count) return true;
  for (std::uint32_t level = 0; level < now.count; ++level)
    if (level_lower(last, level) != level_lower(now, level)) return true;
  return false;
}

// Half of the memory is for links, as far as they can have it.
std::uint32_t most_pages(const LightCacheOptions& options) {
  return count_pages(static_cast<std::uint64_t>(options.memory) << 19, static_cast<std::uint32_t>(options.links));
}

// That fit into the rest, and into what a shader reaches of a buffer.
std::uint32_t most_faces(const LightCacheOptions& options, std::uint64_t descriptor_range) {
  const std::uint64_t kept =
      sizeof(glsl::FaceLight) + sizeof(glsl::LitFace) + (1 + glsl::kInjectWords) * sizeof(std::uint32_t);
  const std::uint64_t bytes =
      2 * kept + (3 + glsl::kShownWords) * sizeof(glm::vec4) + sizeof(glsl::LitFace) + 4 * sizeof(std::uint32_t);
  const std::uint64_t links =
      std::uint64_t{most_pages(options)} * static_cast<std::uint64_t>(options.links) * sizeof(glsl::FaceLink);
  constexpr std::uint64_t kLargest =
      std::max({sizeof(glsl::FaceLight), glsl::kVoteWords * sizeof(std::uint32_t),
                glsl::kInjectWords * sizeof(std::uint32_t), glsl::kShownWords * sizeof(glm::vec4)});
  const std::uint64_t in_memory = ((static_cast<std::uint64_t>(options.memory) << 20) - links) / bytes;
  return static_cast<std::uint32_t>(std::max<std::uint64_t>(std::min(in_memory, descriptor_range / kLargest), 1));
}

}  // namespace

void LightCache::describe(OptionVisitor& visitor, LightCacheOptions& options) {
  constexpr OptionScope kWorld = OptionScope::kWorld;
  visitor.visit(
      {"resolution", "Voxels along the longest axis of the scene, and along each side of every level within it.",
       "voxels", "time and memory with its square", kWorld},
      options.resolution, 8, 256);
  visitor.visit({"finest-cell",
                 "Levels of voxels half as large are added about the camera until they are no larger than this; none "
                 "where twice this is enough. 0: one level.",
                 "m", "time and memory with the number of levels", kWorld},
                options.finest_cell, 0.0f, 1e6f);
  visitor.visit(
      {"memory", "For the light of voxels, at most; where it ends, the coarser levels answer.", "MiB", "", kWorld},
      options.memory, 1, 65536);
  visitor.visit({"links", "Rays that a voxel's side remembers.", "",
                 "memory, time, and frames until what moved is forgotten; less noise", kWorld},
                options.links, 1, 512);
  visitor.visit({"links-per-frame", "Of these, how many are traced in a frame.", "", "time in proportion", kWorld},
                options.links_per_frame, 1, 64);
  visitor.visit(
      {"turns",
       "Levels take turns: the finest gathers light in each frame, the next in every second one, and so on up "
       "to every n-th. 1: all in each.",
       "frames", "less time; coarse levels lag", kWorld},
      options.turns, 1, 64);
}

// What a face keeps from frame to frame beside its links.
struct LightCache::FaceState {
  BufferHandle light;     // glsl::FaceLight a face
  BufferHandle votes;     // glsl::kVoteWords uints a face
  BufferHandle injected;  // glsl::kInjectWords uints a face
  BufferHandle lit;       // glsl::LitFace a face
  bool fresh = false;
};

LightCache::FaceState LightCache::find_state(FrameGraph& graph, std::uint32_t side, std::uint32_t capacity) {
  FaceState state;
  const auto find = [&](std::string name, std::uint64_t count, std::uint32_t stride) {
    bool fresh = false;
    const BufferHandle buffer = graph.history_buffer(side == 0 ? name : name + " 2", count, stride, fresh);
    state.fresh = state.fresh || fresh;
    return buffer;
  };
  state.light = find("face light", capacity, sizeof(glsl::FaceLight));
  state.votes = find("face votes", std::uint64_t{capacity} * glsl::kVoteWords, sizeof(std::uint32_t));
  state.injected = find("face injections", std::uint64_t{capacity} * glsl::kInjectWords, sizeof(std::uint32_t));
  state.lit = find("lit faces", capacity, sizeof(glsl::LitFace));
  return state;
}

LinkPageSettings LightCache::page_settings() const {
  return {.links = static_cast<std::uint32_t>(options_.links),
          .first = (faces_.capacity + 1) / kFacesOfAPage,
          .most = most_pages(options_)};
}

// The faces' state, where this frame's faces are.
void LightCache::find_light(FrameGraph& graph, const WorldFrame& world) {
  pages_ = page_pool_.find(graph, page_settings());
  params_.page_count = pages_.count;
  const std::uint32_t side = faces_.moved ? 1 - side_ : side_;
  FaceState state = find_state(graph, side, faces_.capacity);
  FaceState before;
  if (faces_.moved) before = find_state(graph, side_, capacity_);
  slot_moves_ = last_slot_moves_ + (faces_.moved ? 1 : 0);
  // Windows will move: with room for both from the start memory does not grow then.
  if (!faces_.moved && faces_.levels.count > 1) find_state(graph, 1 - side, faces_.capacity);
  fresh_ = (faces_.moved ? before.fresh : state.fresh) || pages_.fresh || faces_.fresh || world.is_cut;
  face_light_ = state.light;
  votes_ = state.votes;
  injected_ = state.injected;
  kept_lit_ = state.lit;
  graph.on_recorded([this, side, capacity = faces_.capacity, moves = slot_moves_] {
    side_ = side;
    capacity_ = capacity;
    last_slot_moves_ = moves;
  });
  if (fresh_) {
    constexpr std::string_view kName = "light cache: clear";
    graph.fill(kName, face_light_, 0);
    graph.fill(kName, votes_, 0);
    graph.fill(kName, injected_, 0);
    graph.fill(kName, kept_lit_, 0);
    graph.fill(kName, pages_.counts, 0);
    BufferHandle owned = graph.create_buffer("owned link pages", pages_.count, sizeof(std::uint32_t));
    graph.fill(kName, owned, 0);
    record_free_pages(graph, pages_, params_, owned);
  } else if (faces_.moved) {
    carry_light(graph, before);
  } else {
    record_new_pages(graph, pages_, params_);
  }
  last_lit_ = graph.create_buffer("last lit faces", faces_.capacity, sizeof(glsl::LitFace));
  graph.copy("light cache: smooth", kept_lit_, last_lit_, std::uint64_t{faces_.capacity} * sizeof(glsl::LitFace));
}

// Links stay in their pages.
void LightCache::carry_light(FrameGraph& graph, const FaceState& before) {
  constexpr std::string_view kName = "light cache: carry";
  BufferHandle owned = graph.create_buffer("owned link pages", pages_.count, sizeof(std::uint32_t));
  graph.fill(kName, owned, 0);
  graph.compute(kName, kernels::light_cache_cache_carry_comp)
      .read("counts", faces_.counts)
      .read("before", faces_.before)
      .read("old_light", before.light)
      .read("old_votes", before.votes)
      .read("old_injected", before.injected)
      .read("old_lit", before.lit)
      .write("face_light", face_light_)
      .write("votes", votes_)
      .write("injected", injected_)
      .write("lit", kept_lit_)
      .write("owned", owned)
      .push(params_)
      .dispatch_indirect(faces_.counts, kFaceGroupsOffset);
  record_free_pages(graph, pages_, params_, owned);
}

void LightCache::record_deposit(FrameGraph& graph, WorldFrame& world) {
  const LightPathSettings settings{
      .paths = static_cast<std::uint32_t>(options_.light_paths), .bounces = 1, .rsm_lights = 0};
  const BufferHandle points = record_light_paths(graph, world, {}, settings, static_cast<std::uint32_t>(world.index));
  glsl::CacheParams params = params_;
  params.count = settings.paths;
  dispatch_linear(graph.compute("light cache: inject", kernels::light_cache_cache_deposit_comp)
                      .read("points", points)
                      .read("face_table", faces_.table)
                      .read("areas", faces_.areas)
                      .write("injected", injected_)
                      .push(params),
                  settings.paths);
}

ComputePass& LightCache::ask(ComputePass& pass) {
  return pass.read("face_table", faces_.table).read("indirect", indirect_).write("votes", votes_);
}

ComputePass& LightCache::inject(ComputePass& pass) {
  return ask(pass).read("shown", shown_).write("injected", injected_);
}

void LightCache::record_round(FrameGraph& graph, WorldFrame& world) {
  is_smoothed_ = false;
  BufferHandle list =
      graph.create_buffer("gathering faces", glsl::kListHeader + std::uint64_t{faces_.capacity}, sizeof(std::uint32_t));
  graph.fill("light cache: resolve", list, 0);
  shown_ =
      graph.create_buffer("shown face light", std::uint64_t{faces_.capacity} * glsl::kShownWords, sizeof(glm::vec4));
  const std::uint64_t fallen_count = glsl::kFallenFaces + std::uint64_t{faces_.capacity};
  BufferHandle fallen = graph.create_buffer("face irradiance", fallen_count, sizeof(glm::vec4));
  BufferHandle solved = graph.create_buffer("solved face irradiance", fallen_count, sizeof(glm::vec4));
  indirect_ = graph.create_buffer("face indirect", faces_.capacity, sizeof(glm::vec4));
  graph.compute("light cache: resolve", kernels::light_cache_cache_resolve_comp)
      .read("counts", faces_.counts)
      .write("face_light", face_light_)
      .write("votes", votes_)
      .write("injected", injected_)
      .write("shown", shown_)
      .write("indirect", indirect_)
      .write("fallen", fallen)
      .write("solved", solved)
      .write("list", list)
      .read("keys", faces_.keys)
      .write("page_counts", pages_.counts)
      .write("free_pages", pages_.free)
      .constant("kFromLights", from_lights() ? 1 : 0)
      .push(params_)
      .dispatch_indirect(faces_.counts, kFaceGroupsOffset);
  graph.compute("light cache: resolve", kernels::light_cache_cache_list_comp)
      .write("list", list)
      .write("page_counts", pages_.counts)
      .push(params_)
      .dispatch(1);

  sources_ = find_direct_sources(world);
  params_.table_size = sources_.table_size;
  params_.emitter_count = sources_.emitter_count;
  params_.light_count = sources_.light_count;
  glsl::CacheParams gathering = params_;
  gathering.count = slot_moves_;
  ComputePass& pass = trace_compute(graph, "light cache: gather", kernels::light_cache_cache_gather_comp, world);
  read_direct_sources(pass, sources_)
      .read("face_table", faces_.table)
      .write("votes", votes_)
      .write("injected", injected_)
      .write("links", pages_.links)
      .write("page_counts", pages_.counts)
      .read("free_pages", pages_.free)
      .write("face_light", face_light_)
      .read("keys", faces_.keys)
      .read("list", list)
      .constant("kFromLights", from_lights() ? 1 : 0)
      .constant("kSeesNeighbours", options_.sees_neighbours ? 1 : 0)
      .push(gathering)
      .dispatch_indirect(list);
  for (int bounce = 0; bounce < options_.bounces_per_frame; ++bounce) {
    if (bounce > 0) std::swap(fallen, solved);
    graph.compute("light cache: solve", kernels::light_cache_cache_solve_comp)
        .constant("kFromLights", from_lights() ? 1 : 0)
        .constant("kLast", bounce + 1 == options_.bounces_per_frame ? 1 : 0)
        .read("list", list)
        .read("links", pages_.links)
        .read("shown", shown_)
        .read("fallen", fallen)
        .write("face_light", face_light_)
        .write("solved", solved)
        .write("indirect", indirect_)
        .push(params_)
        .dispatch_indirect(list);
  }
}

// Of which links and light there are those of long ago. Where only the order of the triangles changed there are none.
void LightCache::note_changes(const WorldFrame& world) {
  const SceneRevisions& now = world.revisions;
  const bool surfaces = !revisions_ || surfaces_changed(*revisions_, now) || faces_.fresh;
  const bool changed = surfaces || revisions_->lights != now.lights || revisions_->environment != now.environment;
  still_frames_ = changed ? 0 : still_frames_ + 1;
  still_surfaces_ = surfaces ? 0 : still_surfaces_ + 1;
  still_windows_ = have_windows_moved(params_.levels, faces_.levels) ? 0 : still_windows_ + 1;
}

// Until all links of a face have been traced.
std::uint32_t LightCache::frames_until_full() const {
  return static_cast<std::uint32_t>(options_.turns *
                                    ((options_.links + options_.links_per_frame - 1) / options_.links_per_frame));
}

std::uint32_t LightCache::frames_until_rest() const {
  return frames_until_full() + kFramesUntilAsked;
}

std::uint32_t LightCache::choose_rest() const {
  if (!options_.rests || still_surfaces_ < frames_until_full()) return glsl::kAllSend;
  if (still_frames_ < frames_until_rest()) return still_frames_ < still_surfaces_ ? glsl::kAllSample : glsl::kAllSend;
  return steady() ? glsl::kYoungSolve : glsl::kYoungSend;
}

bool LightCache::steady() const {
  const auto bounces = static_cast<std::uint32_t>(options_.bounces_per_frame);
  const auto turns = static_cast<std::uint32_t>(options_.turns);
  return options_.rests &&
         std::min(still_frames_, still_windows_) >= frames_until_rest() + turns * kBouncesUntilSettled / bounces;
}

void LightCache::warn_of_albedo(const WorldFrame& world) {
  if (warned_ || world.scene.albedo_maximum < 1.0f) return;
  warned_ = true;
  log_warning("a material has albedo 1: in a closed space its light does not settle");
}

void LightCache::record(FrameGraph& graph, WorldFrame& world) {
  warn_of_albedo(world);
  faces_ = record_voxel_faces(
      graph, world,
      {.levels = {.resolution = static_cast<std::uint32_t>(options_.resolution), .finest_cell = options_.finest_cell},
       .areas = from_lights(),
       .capacity = most_faces(options_, graph.descriptor_range())},
      face_memory_);
  note_changes(world);
  const bool is_known = revisions_ && !faces_.fresh;
  const bool changed = still_frames_ == 0 && is_known;
  const bool moved = still_surfaces_ == 0 && is_known;
  const auto rays = static_cast<float>(options_.links_per_frame);
  const auto links = static_cast<float>(options_.links);
  const auto history = static_cast<float>(options_.history);
  params_ = {.levels = faces_.levels,
             .frame = static_cast<std::uint32_t>(world.index),
             .capacity = faces_.capacity,
             .most_direct = changed ? kMostDirectInChange : history * (from_lights() ? 1.0f : kSamplesAFrame),
             .most_gathered = rays * (moved ? kMostGatheredInChange : history),
             .link_count = static_cast<std::uint32_t>(options_.links),
             .rays = static_cast<std::uint32_t>(options_.links_per_frame),
             .rest = choose_rest()};
  // Who rested wakes those that their light comes from, and these others: all at once at first.
  sampled_frames_ = params_.rest == glsl::kAllSample ? sampled_frames_ + 1 : 0;
  params_.asks = sampled_frames_ == 0 ? 0 : sampled_frames_ <= glsl::kMostAsking ? params_.link_count : params_.rays;
  find_light(graph, world);
  // Faces that a camera newly comes upon fade in over all their links; those that are as old as all others need not.
  known_frames_ = fresh_ ? 0 : known_frames_ + 1;
  params_.settled = std::clamp(rays * static_cast<float>(known_frames_), std::min(glsl::kSettledLinks, links), links);
  // While windows move on, what pixels read follows slowly; where light or surfaces change, at once.
  agreed_frames_ =
      changed || known_frames_ < kFramesToAgree ? 1 : kFramesToAgree - std::min(still_windows_, kFramesToAgree - 1);
  params_.turns = fresh_ ? 1 : static_cast<std::uint32_t>(options_.turns);
  if (from_lights()) record_deposit(graph, world);
  record_round(graph, world);
  page_pool_.watch(graph, pages_, page_settings());
  graph.on_recorded([this, revisions = world.revisions] { revisions_ = revisions; });
}

std::map<std::string, std::uint64_t> LightCache::counts() const {
  const FaceRoom& room = *face_memory_.room;
  const LinkNeed& need = page_pool_.need();
  return {{"faces", room.stored},
          {"faces left out", room.found - room.stored},
          {"faces with links", need.used},
          {"faces that found no room for links", need.missing}};
}

glsl::CacheParams LightCache::view_params(const ViewFrame& view) const {
  glsl::CacheParams params = params_;
  params.size = {view.gbuffer.width, view.gbuffer.height};
  return params;
}

void LightCache::record_smooth(FrameGraph& graph) {
  if (is_smoothed_) return;
  is_smoothed_ = true;
  glsl::CacheParams params = params_;
  params.count = agreed_frames_;
  graph.compute("light cache: smooth", kernels::light_cache_cache_smooth_comp)
      .read("counts", faces_.counts)
      .read("keys", faces_.keys)
      .read("face_table", faces_.table)
      .read("face_light", face_light_)
      .read("indirect", indirect_)
      .read("lit", last_lit_)
      .write("smoothed", kept_lit_)
      .push(params)
      .dispatch_indirect(faces_.counts, kFaceGroupsOffset);
}

ComputePass& LightCache::ask_smoothed(ComputePass& pass) {
  return pass.read("face_table", faces_.table).read("keys", faces_.keys).read("lit", kept_lit_).write("votes", votes_);
}

ImageHandle LightCache::record_look_up(FrameGraph& graph, const ViewFrame& view) {
  ImageHandle irradiance = create_irradiance(graph, view.gbuffer);
  record_smooth(graph);
  ComputePass& pass = graph.compute("light cache: look-up", kernels::light_cache_cache_look_up_comp);
  ask_smoothed(pass)
      .read("position", view.gbuffer.position)
      .read("normal", view.gbuffer.normal)
      .read("face", view.gbuffer.face)
      .write("irradiance", irradiance)
      .push(view_params(view))
      .dispatch_threads(view.gbuffer.width, view.gbuffer.height);
  return irradiance;
}

BufferHandle LightCache::record_points(FrameGraph& graph, BufferHandle points, std::uint32_t count) {
  BufferHandle irradiance = graph.create_buffer("point irradiance", count, sizeof(glm::vec4));
  glsl::CacheParams params = params_;
  params.count = count;
  record_smooth(graph);
  ComputePass& pass = graph.compute("light cache: points", kernels::light_cache_cache_points_comp);
  ask_smoothed(pass).read("points", points).write("irradiance", irradiance).push(params);
  dispatch_linear(pass, count);
  return irradiance;
}

ImageHandle LightCache::record_view(FrameGraph& graph, const ViewFrame& view, bool shows_indirect) const {
  ImageHandle picture = create_irradiance(graph, view.gbuffer);
  graph.compute("light cache: view", kernels::light_cache_cache_view_comp)
      .read("position", view.gbuffer.position)
      .read("face", view.gbuffer.face)
      .read("face_table", faces_.table)
      .read("shown", shown_)
      .read("indirect", indirect_)
      .write("picture", picture)
      .constant("kIndirect", shows_indirect ? 1 : 0)
      .push(view_params(view))
      .dispatch_threads(view.gbuffer.width, view.gbuffer.height);
  return picture;
}

}  // namespace lightwell
