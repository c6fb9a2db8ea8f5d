#include "techniques/light_volume/surfel_solver.h"

#include <algorithm>
#include <array>

#include "techniques/light_volume/surfel_passes.h"

namespace lightwell {
namespace {

// After this many bounces nothing changes any more: 0.8^64 < 1e-6.
constexpr std::uint32_t kSteadyBounces = 64;
// The light is nearly there when the last links arrive.
constexpr std::uint32_t kSteadyBouncesAfterTrace = 32;

}  // namespace

void LightVolumeBest::describe(OptionVisitor& visitor) {
  visitor.visit({"resolution", "Cells along the longest axis of the grid.", "cells",
                 "time and memory, both about with its square", OptionScope::kWorld},
                options_.resolution, 8, 256);
  visitor.visit({"links", "Rays that each surfel gathers light along, in all; more give less noise.", "",
                 "4 bytes a surfel, a longer solution, and longer until all are traced", OptionScope::kWorld},
                options_.links, 1, 512);
  visitor.visit({"links-per-frame", "Of these, how many are traced in a frame after the geometry has changed.", "",
                 "a ray a surfel", OptionScope::kWorld},
                options_.links_per_frame, 1, 512);
  visitor.visit({"bounces-per-frame", "Bounces of light added in a frame; all the others come from the frames before.",
                 "", "a reading of all links", OptionScope::kWorld},
                options_.bounces_per_frame, 1, 16);
}

glsl::SurfelParams LightVolumeBestWorld::make_params(const WorldFrame& world, const SurfelSizes& sizes) const {
  glsl::SurfelParams params{};
  params.grid = *grid_;
  params.triangle_count = world.scene.triangle_count;
  params.emission_scale = world.scene.emission_maximum > 0.0f ? world.scene.emission_maximum : 1.0f;
  params.capacity = sizes.capacity;
  params.link_count = sizes.links;
  params.first_link = next_link_;
  params.traced_links = std::min(static_cast<std::uint32_t>(options_.links_per_frame), links_left_);
  params.used_links = std::min(sizes.links, used_links_ + params.traced_links);
  params.light_count = world.lights.count;
  params.bounced_only = covered_ == LightKinds::kBounced ? 1 : 0;
  return params;
}

bool LightVolumeBestWorld::is_steady() const {
  return links_left_ == 0 && bounces_since_change_ >= kSteadyBounces &&
         bounces_since_trace_ >= kSteadyBouncesAfterTrace;
}

void LightVolumeBestWorld::record_world(FrameGraph& graph, WorldFrame& world) {
  if (world.is_cut) grid_.reset();
  const VoxelGrid grid = keep_voxel_grid(grid_, world.grid_bounds, static_cast<std::uint32_t>(options_.resolution));
  const bool same_grid = grid_ && is_same_grid(*grid_, grid);
  grid_ = grid;
  const SurfelSizes sizes = choose_surfel_sizes(grid, static_cast<std::uint32_t>(options_.links));
  bool fresh = false;
  volume_ = find_surfel_volume(graph, grid, sizes, fresh);

  // What has changed, and what is still to be done about it. The environment's light is added up with the links.
  const bool restart = fresh || !same_grid;
  const bool links_changed =
      restart || surfaces_changed(revisions_, world.revisions) || revisions_.environment != world.revisions.environment;
  const bool lights_changed = revisions_.lights != world.revisions.lights;
  revisions_ = world.revisions;
  if (restart) next_link_ = used_links_ = 0;
  if (links_changed) links_left_ = sizes.links;
  if (links_changed || lights_changed) bounces_since_change_ = bounces_since_trace_ = 0;

  params_ = make_params(world, sizes);
  if (links_changed) record_surfels(graph, volume_, world, params_, !restart);
  if (links_left_ > 0) {
    record_links(graph, volume_, world, params_, links_changed);
    next_link_ = (next_link_ + params_.traced_links) % sizes.links;
    used_links_ = params_.used_links;
    links_left_ -= params_.traced_links;
    bounces_since_trace_ = 0;
  }
  if (is_steady()) return;
  const auto bounces = static_cast<std::uint32_t>(options_.bounces_per_frame);
  record_solution(graph, volume_, world, params_, bounces);
  bounces_since_change_ += bounces;
  bounces_since_trace_ += bounces;
}

BufferHandle LightVolumeBestWorld::record_points(FrameGraph& graph, WorldFrame& world, const Points& points) {
  return record_surfel_points(graph, volume_, world, params_, points);
}

GiResult LightVolumeBest::record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) {
  constexpr std::array<std::string_view, 3> kNames{"surfel-irradiance", "surfel-albedo", "surfel-validity"};
  const auto& shared = *static_cast<LightVolumeBestWorld*>(world);
  glsl::SurfelParams params = shared.params();
  params.size = {view.gbuffer.width, view.gbuffer.height};
  views_.clear();
  for (std::uint32_t kind = 0; kind < kNames.size(); ++kind)
    views_.push_back({kNames[kind], record_surfel_view(graph, shared.volume(), view, params, kind)});
  return {.irradiance = record_surfel_lookup(graph, shared.volume(), view, params), .steady = shared.is_steady()};
}

}  // namespace lightwell
