#include "techniques/photon_splatting/world_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "core/log.h"
#include "shaders/light_point.h"
#include "techniques/photon_splatting/splat_types.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kMostPaths = 65536;  // a round: what record_light_paths() takes
// Where there are more light points, paths come in so many rounds at least: one after the other use the same memory.
constexpr std::uint32_t kManyPoints = 16384;
constexpr std::uint32_t kLeastRounds = 4;
constexpr std::uint32_t kLeastCells = 8;    // of grids along an axis, stratify = 0 being none
constexpr std::uint32_t kLeastMapSide = 4;  // texels
constexpr std::array<std::string_view, 6> kGrids{"off", "16", "32", "64", "128", "256"};
constexpr std::array<std::string_view, 2> kRepresentatives{"random", "nearest"};
constexpr std::array<std::string_view, 2> kWidthModes{"fixed", "adaptive"};
constexpr std::array<std::string_view, 3> kKernels{"box", "tent", "gaussian"};
constexpr std::array<std::string_view, 4> kMapSides{"4", "8", "16", "32"};

template <class Enum, std::size_t n>
void visit_choice(OptionVisitor& visitor, const OptionInfo& info, Enum& value,
                  const std::array<std::string_view, n>& choices) {
  int index = static_cast<int>(value);
  visitor.visit(info, index, choices);
  value = static_cast<Enum>(index);
}

void describe_stratification(OptionVisitor& visitor, PhotonOptions& options) {
  constexpr OptionScope kWorld = OptionScope::kWorld;
  visitor.visit({"stratify", "Photons in one cell of a grid become one splat: cells along the longest axis.", "cells",
                 "more splats", kWorld},
                options.stratify, kGrids);
  visitor.visit({"threshold", "Cells with fewer photons merge with their block of 2 x 2 x 2.", "photons", "", kWorld},
                options.threshold, 1, 1024);
  visitor.visit({"merge-levels", "How often blocks with too few photons merge again.", "", "", kWorld},
                options.merge_levels, 0, 8);
  visit_choice(visitor,
               {"representative",
                "Which photon gives the splat of a cell its place and direction: any, or the one "
                "nearest to the mean.",
                "", "", kWorld},
               options.representative, kRepresentatives);
}

void describe_splats(OptionVisitor& visitor, PhotonOptions& options) {
  constexpr OptionScope kWorld = OptionScope::kWorld;
  visit_choice(visitor,
               {"width-mode", "Splats are alike in width, or as wide as photons are far apart there.", "", "", kWorld},
               options.width_mode, kWidthModes);
  visitor.visit({"width", "Of splats that are alike; those of m photons are wider by the root of m.",
                 "of the scene's diagonal", "time with its square", kWorld},
                options.width, 1e-4f, 1.0f);
  visit_choice(visitor, {"kernel", "How a splat's light falls off with the distance from its ray.", "", "", kWorld},
               options.kernel, kKernels);
  visitor.visit({"kernel-photons", "Photons that an adaptive splat overlaps, about.", "",
                 "time in proportion; less noise, more blur", kWorld},
                options.kernel_photons, 1.0f, 1024.0f);
  visitor.visit({"least-width", "Of all splats.", "of the scene's diagonal", "", kWorld}, options.least_width, 1e-5f,
                1.0f);
  visitor.visit({"most-width", "Of all splats.", "of the scene's diagonal", "time with its square", kWorld},
                options.most_width, 1e-5f, 1.0f);
  visitor.visit(
      {"progressive",
       "Kernels shrink while the scene stays as it is, so that the mean of all frames converges to the truth.", "",
       "noise", kWorld},
      options.progressive);
  visitor.visit({"step-back", "How far before and behind a splat's end its map reaches, without the receiver test.",
                 "of the scene's diagonal", "", kWorld},
                options.step_back, 1e-5f, 1.0f);
  visitor.visit({"map-size", "Side of a splat's shadow map.", "texels", "rays and memory with its square", kWorld},
                options.map_size, kMapSides);
  visitor.visit({"receiver-test",
                 "Splats light the surface that they end on only; what of them meets others is made up for there.", "",
                 "", kWorld},
                options.receiver_test);
}

// m; 1 where the bounds are none.
float diagonal_of(const Bounds& bounds) {
  const float diagonal = glm::length(bounds.maximum - bounds.minimum);
  return std::isfinite(diagonal) && diagonal > 0.0f ? diagonal : 1.0f;
}

}  // namespace

void describe_photon_options(OptionVisitor& visitor, PhotonOptions& options) {
  constexpr OptionScope kWorld = OptionScope::kWorld;
  visitor.visit({"photons", "Light paths; each sends a photon on from every surface that it meets.", "",
                 "time and memory in proportion", kWorld},
                options.photons, 16, 1048576);
  visitor.visit({"bounces", "Surfaces that light meets on its way, at most, the visible one not counted.", "",
                 "memory in proportion, and time as far as light goes", kWorld},
                options.bounces, 1, static_cast<int>(glsl::kPhotonBounces));
  visitor.visit(
      {"rsm-size", "Side of one view of a reflective shadow map.", "texels", "time and memory with its square", kWorld},
      options.rsm_size, 32, 1024);
  visitor.visit(
      {"rsm-lights", "Where there are at most so many lights, paths begin in reflective shadow maps; else with rays.",
       "", "a drawing of the scene a light, where something moves", kWorld},
      options.rsm_lights, 0, 256);
  visitor.visit({"same-photons", "The same photons in every frame.", "", "", kWorld}, options.same_photons);
  visitor.visit({"guide", "More photons start where views have seen such in the frames before.", "", "", kWorld},
                options.guide);
  describe_stratification(visitor, options);
  describe_splats(visitor, options);
}

// Where the atlas has no room for a map of every light point, maps are smaller, and then there are fewer photons.
PhotonWorld::Rounds PhotonWorld::fit(const WorldFrame& world) {
  const auto bounces = static_cast<std::uint32_t>(options_.bounces);
  const std::uint32_t wanted_side = kLeastMapSide << options_.map_size;
  const std::uint32_t cells = kLeastCells << options_.stratify;
  const auto count_maps = [&](const Rounds& rounds) {
    const std::uint32_t points = rounds.paths * rounds.count * bounces;
    return options_.stratify > 0 ? std::min(points, cells * cells * cells) : points;
  };
  // As many photons or a few less.
  const auto divide = [&](std::uint32_t photons) {
    const bool many = options_.stratify == 0 && photons * bounces > kManyPoints;
    const std::uint32_t count = std::max((photons + kMostPaths - 1) / kMostPaths, many ? kLeastRounds : 1);
    return Rounds{photons / count, count};
  };
  Rounds rounds = divide(static_cast<std::uint32_t>(options_.photons));
  layout_ = fit_splat_maps(count_maps(rounds), wanted_side, world.largest_image());
  const bool too_many = layout_.capacity < count_maps(rounds);
  if (too_many) {
    rounds = divide(layout_.capacity / bounces);
    layout_ = fit_splat_maps(count_maps(rounds), wanted_side, world.largest_image());
  }
  if (!warned_ && (too_many || layout_.map_side < wanted_side)) {
    warned_ = true;
    const std::string side = std::to_string(layout_.map_side);
    log_warning("photon-splatting: no room for all shadow maps: there are " +
                std::to_string(rounds.paths * rounds.count) + " photons, with maps of " + side + " x " + side);
  }
  return rounds;
}

SizedLightPaths PhotonWorld::record_paths(FrameGraph& graph, WorldFrame& world, std::uint32_t paths,
                                          std::uint32_t round, LightPathGuide* guide) {
  const LightPathSettings settings{.paths = paths,
                                   .bounces = static_cast<std::uint32_t>(options_.bounces),
                                   .rsm_lights = static_cast<std::uint32_t>(options_.rsm_lights)};
  if (options_.width_mode == SplatWidth::kAdaptive)
    return record_sized_light_paths(graph, world, rsm_, settings, round, guide);
  SizedLightPaths result{.points = record_light_paths(graph, world, rsm_, settings, round)};
  result.areas = graph.create_buffer("no areas", 1, sizeof(float));
  graph.fill("photon splatting: photons", result.areas, 0);
  return result;
}

// Of all rounds, one after the other.
SizedLightPaths PhotonWorld::record_all_paths(FrameGraph& graph, WorldFrame& world, const Rounds& rounds,
                                              std::uint32_t first) {
  if (rounds.count == 1) return record_paths(graph, world, rounds.paths, first);
  const std::uint64_t count = std::uint64_t{rounds.paths} * static_cast<std::uint32_t>(options_.bounces);
  const bool sized = options_.width_mode == SplatWidth::kAdaptive;
  SizedLightPaths all{
      .points = graph.create_buffer("all light points", count * rounds.count, sizeof(glsl::LightPoint)),
      .areas = graph.create_buffer("all light point areas", sized ? count * rounds.count : 1, sizeof(float))};
  for (std::uint32_t i = 0; i < rounds.count; ++i) {
    constexpr std::string_view kName = "photon splatting: stratify";
    const SizedLightPaths round = record_paths(graph, world, rounds.paths, first + i);
    const std::uint64_t points_size = count * sizeof(glsl::LightPoint);
    const std::uint64_t areas_size = sized ? count * sizeof(float) : sizeof(float);
    graph.copy(kName, round.points, all.points, points_size, 0, i * points_size);
    graph.copy(kName, round.areas, all.areas, areas_size, 0, sized ? i * areas_size : 0);
  }
  return all;
}

// The area of kernels shrinks so that it is 0 in the end and noise of the mean still falls: by (i + 2/3) / (i + 1) from
// frame i on to the next (Knaus and Zwicker 2011, with their alpha of 2/3).
void PhotonWorld::note_changes(const WorldFrame& world) {
  if (world.is_cut || revisions_ != world.revisions) still_frames_ = 0, shrinking_ = 1.0f;
  revisions_ = world.revisions;
  ++still_frames_;
  if (!options_.progressive || still_frames_ == 1) return;
  const auto i = static_cast<float>(still_frames_ - 1);
  shrinking_ *= (i + 2.0f / 3.0f) / (i + 1.0f);
}

void PhotonWorld::record_world(FrameGraph& graph, WorldFrame& world) {
  note_changes(world);
  const Rounds rounds = fit(world);
  const bool stratified = options_.stratify > 0;
  const std::uint32_t first_round = options_.same_photons ? 0 : static_cast<std::uint32_t>(world.index) * rounds.count;
  const bool adaptive = options_.width_mode == SplatWidth::kAdaptive;
  const float diagonal = diagonal_of(world.grid_bounds);
  const float kernels_diagonal = diagonal * std::sqrt(shrinking_);
  capacity_ = layout_.capacity;
  const bool from_maps = starts_from_maps(world, {.rsm_lights = static_cast<std::uint32_t>(options_.rsm_lights)});
  const bool guided =
      options_.guide && adaptive && !stratified && !options_.same_photons && !from_maps && guide_.begin(graph, world);
  PhotonSplats splats =
      begin_splats(graph,
                   {.paths = rounds.paths,
                    .bounces = static_cast<std::uint32_t>(options_.bounces),
                    .rounds = stratified ? rounds.count : 1,
                    .all_rounds = rounds.count,
                    .first_path = first_round * rounds.paths,
                    .capacity = capacity_,
                    .map_side = layout_.map_side,
                    .maps_per_row = layout_.maps_per_row,
                    .half_width = adaptive ? 0.0f : 0.5f * options_.width * kernels_diagonal,
                    .photons = options_.kernel_photons * shrinking_,
                    .least_half = 0.5f * std::min(options_.least_width, options_.most_width) * kernels_diagonal,
                    .most_half = 0.5f * options_.most_width * kernels_diagonal,
                    .step_back = options_.receiver_test ? 0.0f : options_.step_back * diagonal},
                   guided);

  rsm_ = {};
  if (from_maps) rsm_ = rsm_maker_.record(graph, world, {.tile_side = static_cast<std::uint32_t>(options_.rsm_size)});
  light_point_count_ = rounds.paths * static_cast<std::uint32_t>(options_.bounces);
  if (stratified) {
    const SizedLightPaths paths = record_all_paths(graph, world, rounds, first_round);
    light_points_ = paths.points;
    light_point_count_ *= rounds.count;
    record_bundles(graph, world, paths,
                   {.cells = kLeastCells << options_.stratify,
                    .threshold = static_cast<std::uint32_t>(options_.threshold),
                    .levels = static_cast<std::uint32_t>(options_.merge_levels),
                    .representative = options_.representative},
                   splats);
  } else {
    for (std::uint32_t i = 0; i < rounds.count; ++i) {
      const SizedLightPaths paths =
          record_paths(graph, world, rounds.paths, first_round + i, guided ? guide_.of_paths() : nullptr);
      splats.params.first_path = (first_round + i) * rounds.paths;
      record_photons(graph, world, paths, splats);
      light_points_ = paths.points;
    }
  }
  shadow_atlas_ = record_shadow_atlas(graph, world, layout_, options_.receiver_test, options_.kernel, splats);
  splats_ = splats.splats;
  splat_counts_ = splats.counts;
  strata_ = splats.strata;
}

}  // namespace lightwell
