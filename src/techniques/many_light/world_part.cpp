#include "techniques/many_light/world_part.h"

#include <array>
#include <cstring>
#include <span>
#include <string>

#include "core/log.h"
#include "passes/svo/svo_view.h"
#include "shaders/light_point.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSmallestResolution = 32;
constexpr std::array<std::string_view, 6> kResolutions{"32", "64", "128", "256", "512", "1024"};

}  // namespace

void describe_world_options(OptionVisitor& visitor, ManyLightWorldOptions& options) {
  constexpr OptionScope kWorld = OptionScope::kWorld;
  visitor.visit(
      {"vpls", "Light paths, rounded down to a multiple of 16; each has one virtual light a bounce.", "",
       options.published ? "time in proportion" : "their making in proportion; the picture hardly more", kWorld},
      options.paths, 16, 65536);
  visitor.visit({"bounces", "Surfaces that light meets on its way, at most, the visible one not counted.", "",
                 "memory and time in proportion", kWorld},
                options.bounces, 1, 8);
  visitor.visit(
      {"rsm-size", "Side of one view of a reflective shadow map.", "texels", "time and memory with its square", kWorld},
      options.rsm_size, 16, 2048);
  visitor.visit(
      {"rsm-lights", "Where there are at most so many lights, paths begin in reflective shadow maps; else with rays.",
       "", "a drawing of the scene a light, where something moves", kWorld},
      options.rsm_lights, 0, 256);
  constexpr std::array<std::string_view, 4> kVisibilities{"triangles", "voxels", "svo-restart", "none"};
  int visibility = static_cast<int>(options.visibility);
  visitor.visit(
      {"visibility",
       "What shadows virtual lights: rays against the scene's triangles (exact), rays through voxels, rays through "
       "an octree of them as published, or nothing.",
       "", "", kWorld},
      visibility, kVisibilities);
  options.visibility = static_cast<Visibility>(visibility);
  visitor.visit({"epsilon", "By how much rays through the octree are shortened at both ends.", "voxels",
                 "less: walls shadow themselves; more: light comes through walls", kWorld},
                options.epsilon, 0.0f, 16.0f);
  visitor.visit({"resolution",
                 options.published ? "Voxels along the longest axis of the scene, for shadows by voxels."
                                   : "Voxels along the longest axis of the scene, and along each side of every level "
                                     "within it, for shadows by voxels.",
                 "voxels", "memory with its square, at 1024 128 MiB a level at least", kWorld},
                options.resolution, kResolutions);
  if (!options.published) {
    visitor.visit({"finest-cell",
                   "Levels of voxels half as large are added about the camera until they are no larger than this; none "
                   "where twice this is enough. 0: one level.",
                   "m", "time and memory with the number of levels", kWorld},
                  options.finest_cell, 0.0f, 1e6f);
  }
  visitor.visit(
      {"svo-memory", "Memory that the voxels may take; where they need more they are coarser.", "MiB", "", kWorld},
      options.svo_memory, 1, 4096);
}

Bounds cluster_bounds(const WorldFrame& world) {
  if (world.focus_balls.empty()) return world.snapshot.bounds;
  const FocusBall& finest = world.focus_balls[0];
  return {finest.center - finest.radius, finest.center + finest.radius};
}

ManyLightWorld::ManyLightWorld(const ManyLightWorldOptions& options) : options_(options) {
  options_.paths -= options_.paths % 16;  // each of 16 parts is a block of as many
}

void ManyLightWorld::record_voxels(FrameGraph& graph, WorldFrame& world) {
  const std::uint32_t resolution = kSmallestResolution << options_.resolution;
  const bool restart = options_.visibility == Visibility::kSvoRestart;
  const SvoSettings settings{.resolution = resolution,
                             .voxels = options_.published ? SvoVoxels::kRasterised : SvoVoxels::kConservative,
                             .budget = std::uint64_t(options_.svo_memory) << 20,
                             .tree = restart,
                             .epsilon = options_.epsilon,
                             .finest_cell = options_.published ? 0.0f : options_.finest_cell,
                             .focus = world.focus};
  const bool unchanged = !world.is_cut && !geometry_changed(revisions_, world.revisions);
  const bool has_last = last_levels_.has_value() && !world.is_cut;
  svo_ = record_svo(graph, world.scene, world.grid_bounds, settings, unchanged, has_last ? &*last_levels_ : nullptr);
  graph.on_recorded([this, levels = svo_.levels] { last_levels_ = levels; });
  watch_voxels(graph, resolution);
}

// What the device finds out arrives later, and is told once.
void ManyLightWorld::watch_voxels(FrameGraph& graph, std::uint32_t resolution) {
  const std::uint32_t deepest = svo_.memory.level + svo_.memory.level_count - 1;
  graph.watch(svo_.counts, [warned = warned_, resolution, level = svo_.memory.level, deepest,
                            cell_size = svo_.levels.levels.cell_size, has_tree = static_cast<bool>(svo_.nodes),
                            budget = options_.svo_memory](std::span<const std::byte> bytes) {
    std::uint32_t reached = deepest;
    if (has_tree) std::memcpy(&reached, bytes.data() + glsl::kSvoLevelReached * sizeof(std::uint32_t), sizeof(reached));
    if (*warned || (reached == deepest && (1u << level) >= resolution)) return;
    *warned = true;
    const std::string what = "many-light: voxels of " + std::to_string(resolution) + "^3 do not fit into svo-memory (" +
                             std::to_string(budget) + " MiB): shadows are those of ";
    if (deepest == level)
      log_warning(what + std::to_string(1u << reached) + "^3");
    else
      log_warning(what + "levels of " + std::to_string(1u << level) + "^3, the finest voxels " +
                  std::to_string(cell_size * static_cast<float>(1u << (deepest - reached))) + " m");
  });
}

void ManyLightWorld::record_world(FrameGraph& graph, WorldFrame& world) {
  LightPathSettings settings{.paths = static_cast<std::uint32_t>(options_.paths),
                             .bounces = static_cast<std::uint32_t>(options_.bounces),
                             .rsm_lights = static_cast<std::uint32_t>(options_.rsm_lights),
                             .sequence = options_.published ? PathSequence::kHalton : PathSequence::kSobol};
  const bool has_voxels = options_.visibility == Visibility::kVoxels || options_.visibility == Visibility::kSvoRestart;
  if (has_voxels) record_voxels(graph, world);
  rsm_ = {};
  if (starts_from_maps(world, settings))
    rsm_ = rsm_maker_.record(graph, world, {.tile_side = static_cast<std::uint32_t>(options_.rsm_size)});
  const std::uint32_t round = options_.published ? 0 : static_cast<std::uint32_t>(world.index);
  points_ = record_light_paths(graph, world, rsm_, settings, round);
  if (options_.published) {
    graph.on_recorded([this, revisions = world.revisions] { revisions_ = revisions; });
    return;
  }

  const std::uint32_t count = settings.paths * settings.bounces;
  clusters_ = record_light_clusters(graph, points_, count, cluster_bounds(world));
  // Kept in every frame: whether something will have changed in the next one is not known.
  const std::uint64_t bytes = std::uint64_t{count} * sizeof(glsl::LightPoint);
  bool fresh = false;
  BufferHandle kept = graph.history_buffer("light points", count, sizeof(glsl::LightPoint), fresh);
  last_points_ = replayed_points_ = {};
  if (!fresh && !world.is_cut && !(revisions_ == world.revisions)) {
    last_points_ = graph.create_buffer("last light points", count, sizeof(glsl::LightPoint));
    graph.copy("many light: keep", kept, last_points_, bytes);
    settings.aims = last_aims_;
    replayed_points_ = record_light_paths(graph, world, rsm_, settings, last_round_);
  }
  graph.copy("many light: keep", points_, kept, bytes);
  graph.on_recorded([this, revisions = world.revisions, round, aims = world.focus_balls] {
    revisions_ = revisions;
    last_aims_ = aims;
    last_round_ = round;
  });
}

void add_world_views(FrameGraph& graph, const ManyLightWorld& world, const ViewFrame& view,
                     std::vector<DebugView>& views) {
  const auto count = static_cast<std::uint32_t>(world.options().paths * world.options().bounces);
  views.push_back({"vpls", record_light_point_view(graph, view, world.points(), count)});
  views.push_back(
      {"vpl-bounces", record_light_point_view(graph, view, world.points(), count, LightPointColor::kBounce)});
  if (const ReflectiveShadowMaps::Frame& rsm = world.rsm()) {
    views.push_back({"rsm-position", rsm.position});
    views.push_back({"rsm-normal", rsm.normal});
    views.push_back({"rsm-flux", rsm.flux});
  }
  if (world.options().visibility == Visibility::kSvoRestart)
    views.push_back({"octree", record_svo_view(graph, view, world.svo())});
}

}  // namespace lightwell
