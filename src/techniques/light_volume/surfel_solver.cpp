#include "techniques/light_volume/surfel_solver.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "techniques/light_volume/surfel_passes.h"

namespace lightwell {
namespace {

// After this many bounces nothing changes any more: 0.8^64 < 1e-6.
constexpr std::uint32_t kSteadyBounces = 64;
// The light is nearly there when the last links arrive.
constexpr std::uint32_t kSteadyBouncesAfterTrace = 32;

bool same_light(const WorldLight& a, const WorldLight& b) {
  return std::tie(a.type, a.position, a.direction, a.intensity, a.cos_inner, a.cos_outer) ==
         std::tie(b.type, b.position, b.direction, b.intensity, b.cos_inner, b.cos_outer);
}

bool holds(const VoxelGrid& grid, const Bounds& bounds) {
  const glm::vec3 upper = upper_corner(grid);
  for (int axis = 0; axis < 3; ++axis)
    if (bounds.minimum[axis] < grid.origin[axis] || bounds.maximum[axis] > upper[axis]) return false;
  return true;
}

}  // namespace

void LightVolumeBest::describe(OptionVisitor& visitor) {
  visitor.visit({"resolution", "Cells along the longest axis of the grid.", "cells",
                 "time and memory, both about with its square"},
                options_.resolution, 8, 128);
  visitor.visit({"links", "Rays that each surfel gathers light along, in all; more give less noise.", "",
                 "4 bytes a surfel, a longer solution, and longer until all are traced"},
                options_.links, 1, 512);
  visitor.visit({"links-per-frame", "Of these, how many are traced in a frame after the geometry has changed.", "",
                 "a ray a surfel"},
                options_.links_per_frame, 1, 512);
  visitor.visit({"bounces-per-frame", "Bounces of light added in a frame; all the others come from the frames before.",
                 "", "a reading of all links"},
                options_.bounces_per_frame, 1, 16);
  visitor.visit({"surfel-views", "Offers the surfels as debug views: surfel-irradiance, surfel-albedo, surfel-trust.",
                 "", "three more passes a frame"},
                options_.surfel_views);
}

// The grid stays where it is as long as it fits: cells that move would invalidate all surfels at once. Once things
// have left it, the next one gets room to spare.
VoxelGrid LightVolumeBest::choose_grid(const Bounds& bounds) {
  constexpr float kWorthShrinking = 0.7f;
  constexpr float kRoomToSpare = 0.1f;
  const auto resolution = static_cast<std::uint32_t>(options_.resolution);
  const VoxelGrid fitted = fit_voxel_grid(bounds, resolution);
  const bool comparable =
      grid_ && grid_->resolution.x == resolution && fitted.cell_size > kWorthShrinking * grid_->cell_size;
  if (!comparable) return fitted;
  if (holds(*grid_, bounds)) return *grid_;
  const glm::vec3 spare(kRoomToSpare * fitted.cell_size * static_cast<float>(resolution));
  return fit_voxel_grid({bounds.minimum - spare, bounds.maximum + spare}, resolution);
}

bool LightVolumeBest::notice_light_changes(const FrameInputs& inputs) {
  const std::vector<WorldLight>& now = inputs.world->lights;
  const bool same = std::equal(now.begin(), now.end(), lights_.begin(), lights_.end(), same_light);
  if (!same) lights_ = now;
  return !same;
}

glsl::SurfelParams LightVolumeBest::make_params(const FrameInputs& inputs, const SurfelSizes& sizes) const {
  glsl::SurfelParams params{};
  params.grid = *grid_;
  params.triangle_count = inputs.scene.triangle_count;
  params.emission_scale = inputs.scene.emission_maximum > 0.0f ? inputs.scene.emission_maximum : 1.0f;
  params.capacity = sizes.capacity;
  params.link_count = sizes.links;
  params.first_link = next_link_;
  params.traced_links = std::min(static_cast<std::uint32_t>(options_.links_per_frame), links_left_);
  params.used_links = std::min(sizes.links, used_links_ + params.traced_links);
  params.light_count = inputs.lights.count;
  params.size = {inputs.gbuffer.width, inputs.gbuffer.height};
  params.bounced_only = inputs.samples_sources ? 1 : 0;
  return params;
}

bool LightVolumeBest::is_steady() const {
  return links_left_ == 0 && bounces_since_change_ >= kSteadyBounces &&
         bounces_since_trace_ >= kSteadyBouncesAfterTrace;
}

void LightVolumeBest::record_views(FrameGraph& graph, const SurfelVolume& volume, const FrameInputs& inputs,
                                   const glsl::SurfelParams& params) {
  constexpr std::array<std::string_view, 3> kNames{"surfel-irradiance", "surfel-albedo", "surfel-trust"};
  views_.clear();
  if (!options_.surfel_views) return;
  for (std::uint32_t kind = 0; kind < kNames.size(); ++kind)
    views_.push_back({kNames[kind], record_surfel_view(graph, volume, inputs, params, kind)});
}

GiResult LightVolumeBest::record(FrameGraph& graph, const FrameInputs& inputs) {
  if (inputs.reset) grid_.reset();
  const VoxelGrid grid = choose_grid(inputs.grid_bounds);
  const bool same_grid = grid_ && grid_->origin == grid.origin && grid_->cell_size == grid.cell_size &&
                         grid_->resolution == grid.resolution;
  grid_ = grid;
  const SurfelSizes sizes = choose_surfel_sizes(grid, static_cast<std::uint32_t>(options_.links));
  bool fresh = false;
  SurfelVolume volume = find_surfel_volume(graph, grid, sizes, fresh);

  // What has changed, and what is still to be done about it.
  const bool restart = fresh || !same_grid;
  const bool geometry_changed = restart || surfaces_changed(revisions_, inputs.revisions);
  const bool lights_changed = notice_light_changes(inputs);
  revisions_ = inputs.revisions;
  if (restart) next_link_ = used_links_ = 0;
  if (geometry_changed) links_left_ = sizes.links;
  if (geometry_changed || lights_changed) bounces_since_change_ = bounces_since_trace_ = 0;

  const glsl::SurfelParams params = make_params(inputs, sizes);
  if (geometry_changed) record_surfels(graph, volume, inputs, params, !restart);
  if (links_left_ > 0) {
    record_links(graph, volume, inputs, params, geometry_changed);
    next_link_ = (next_link_ + params.traced_links) % sizes.links;
    used_links_ = params.used_links;
    links_left_ -= params.traced_links;
    bounces_since_trace_ = 0;
  }
  if (!is_steady()) {
    const auto bounces = static_cast<std::uint32_t>(options_.bounces_per_frame);
    record_solution(graph, volume, inputs, params, bounces);
    bounces_since_change_ += bounces;
    bounces_since_trace_ += bounces;
  }
  GiResult result;
  result.irradiance = record_surfel_lookup(graph, volume, inputs, params);
  result.steady = is_steady();
  record_views(graph, volume, inputs, params);
  return result;
}

}  // namespace lightwell
