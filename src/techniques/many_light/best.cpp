#include "techniques/many_light/best.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "kernels/techniques/many_light/add_near.comp.h"
#include "kernels/techniques/many_light/change.comp.h"
#include "kernels/techniques/many_light/light_gather_rays.comp.h"
#include "kernels/techniques/many_light/light_gather_svo.comp.h"
#include "kernels/techniques/many_light/light_gather_unshadowed.comp.h"
#include "kernels/techniques/many_light/light_gather_voxels.comp.h"
#include "kernels/techniques/many_light/near_direct.comp.h"
#include "kernels/techniques/many_light/near_hits.comp.h"
#include "passes/noise_filter/light_change.h"
#include "passes/noise_filter/noise_filter.h"
#include "passes/sampled_lights/direct_sources.h"
#include "techniques/many_light/many_light_types.h"

namespace lightwell {
namespace {

constexpr GatherKernels kGather{kernels::many_light_light_gather_rays_comp,
                                kernels::many_light_light_gather_voxels_comp, kernels::many_light_light_gather_svo_comp,
                                kernels::many_light_light_gather_unshadowed_comp};

// Of the least distance, after the last short ray.
constexpr float kLastClamp = 0.25f;

// Frames without change after which a picture is steady.
constexpr int kSteadyFrames = 64;

// Independent sequences of random numbers, so many for each depth of gathering.
constexpr std::uint32_t kSequences = 8;
enum Sequence : std::uint32_t { kChoice = 16, kNear = 17, kDirect = 18 };

ImageHandle create(FrameGraph& graph, std::string_view name, const Receivers& receivers, VkFormat format) {
  return graph.create_image(name, {.width = receivers.width, .height = receivers.height, .format = format});
}

// Of a small scene a part of its diagonal, everywhere.
LightClamp make_clamp(const WorldFrame& world, float part) {
  const Bounds& bounds = world.snapshot.bounds;
  const float diagonal = glm::length(bounds.maximum - bounds.minimum);
  LightClamp clamp{.part = part, .nearest = diagonal, .farthest = diagonal};
  if (world.focus_balls.empty()) return clamp;
  clamp.focus = world.focus_balls[0].center;
  clamp.nearest = world.focus_balls[0].radius;
  return clamp;
}

void read_receivers(ComputePass& pass, const Receivers& receivers) {
  pass.read("position", receivers.position).read("normal", receivers.normal).read("face", receivers.face);
}

}  // namespace

// What the gathering at all depths shares in one frame.
struct ManyLightBest::Gathering {
  const ManyLightWorld& part;
  ViewFrame& view;
  LearnedVisibility learned;
  LightTiles tiles;
  LightClamp clamp;
  ImageHandle memory;  // of the pixels' first rays
};

void ManyLightBest::describe(OptionVisitor& visitor) {
  describe_world_options(visitor, world_options_);
  visitor.visit(
      {"clamp",
       "Distance below which a virtual light gets no brighter, as part of the scene's diagonal, of scenes beyond 60 m "
       "as part of its distance from the camera; what that leaves out comes by short rays.",
       "", "longer rays"},
      options_.clamp, 0.0f, 1.0f);
  visitor.visit({"candidates", "Virtual lights that are compared for each ray.", "", "time in proportion"},
                options_.candidates, 1, 256);
  visitor.visit({"rays", "Shadow rays a pixel and frame.", "", "time in proportion"}, options_.rays, 1, 4);
  visitor.visit({"near-bounces", "Short rays one after the other that bring what the clamp leaves out; 0: it is lost.",
                 "", "a short ray and two shadow rays a pixel"},
                options_.near_bounces, 0, 3);
  visitor.visit({"history", "Frames that a pixel's mean counts at most; 0: each frame by itself.", "", ""},
                options_.history, 0, 100000);
  visitor.visit({"filter", "Smooth what noise is left.", "", "eight readings of the picture"}, options_.filter);
}

// Whether no short rays follow. What the clamp leaves out there is lost, so it is less.
bool ManyLightBest::is_last(std::uint32_t depth) const {
  return depth >= static_cast<std::uint32_t>(options_.near_bounces);
}

// Light at receivers of which the light has met `depth` surfaces more on its way to the camera.
ImageHandle ManyLightBest::gather(FrameGraph& graph, Gathering& g, const Receivers& receivers, std::uint32_t depth) {
  const auto rays = static_cast<std::uint32_t>(depth == 0 ? options_.rays : 1);
  LightClamp clamp = g.clamp;
  if (depth > 0 && is_last(depth)) clamp.part *= kLastClamp;
  const ImageHandle choice = record_light_choice(
      graph, receivers, g.part.clusters(), g.tiles,
      {.candidates = static_cast<std::uint32_t>(depth == 0 ? options_.candidates : (options_.candidates + 3) / 4),
       .rays = rays,
       .first_sample = static_cast<std::uint32_t>(g.view.world.index) * rays,
       .sequence = kChoice + kSequences * depth,
       .most_bounces = static_cast<std::uint32_t>(world_options_.bounces) - depth,
       .clamp = clamp});
  glsl::LightGatherParams params{
      .size = {receivers.width, receivers.height}, .rays = rays, .clearance = receivers.clearance};
  set_clamp(clamp, params);
  ImageHandle irradiance = create(graph, "gathered light", receivers, VK_FORMAT_R32G32B32A32_SFLOAT);
  ImageHandle memory = depth == 0 ? g.memory : create(graph, "no memory", receivers, VK_FORMAT_R32G32B32A32_UINT);
  ComputePass& pass = gather_compute(graph, "many light: gather", kGather, g.view.world, g.part);
  read_receivers(pass, receivers);
  pass.read("choice", choice)
      .read("points", g.part.clusters().points)
      .read("clusters", g.part.clusters().clusters)
      .read("tiles", g.tiles.tiles)
      .write("learned", g.learned.table)
      .write("irradiance", irradiance)
      .write("memory", memory)
      .constant("kRemember", depth == 0 ? 1 : 0)
      .push(params)
      .dispatch_threads(receivers.width, receivers.height);
  if (depth == 0) g.memory = memory;
  return irradiance;
}

// `far`: what the clamped light points bring. Adds the rest.
ImageHandle ManyLightBest::add_nearby(FrameGraph& graph, Gathering& g, const Receivers& receivers, ImageHandle far,
                                      std::uint32_t depth) {
  const auto bounces = static_cast<std::uint32_t>(world_options_.bounces);
  if (is_last(depth) || depth >= bounces || g.clamp.part <= 0.0f) return far;
  WorldFrame& world = g.view.world;
  const glm::uvec2 size(receivers.width, receivers.height);
  const std::uint32_t sequences = kSequences * depth;
  const auto index = static_cast<std::uint32_t>(world.index);

  Receivers near{create(graph, "near position", receivers, VK_FORMAT_R32G32B32A32_SFLOAT),
                 create(graph, "near normal", receivers, VK_FORMAT_R16G16B16A16_SFLOAT),
                 create(graph, "near face", receivers, VK_FORMAT_R16G16B16A16_SFLOAT), receivers.width,
                 receivers.height};
  ImageHandle factor = create(graph, "near factor", receivers, VK_FORMAT_R16G16B16A16_SFLOAT);
  glsl::NearParams params{
      .size = size, .clearance = receivers.clearance, .sample_index = index, .sequence = kNear + sequences};
  set_clamp(g.clamp, params);
  ComputePass& hits = trace_compute(graph, "many light: near hits", kernels::many_light_near_hits_comp, world);
  read_receivers(hits, receivers);
  hits.write("near_position", near.position)
      .write("near_normal", near.normal)
      .write("near_face", near.face)
      .write("factor", factor)
      .push(params)
      .dispatch_threads(size.x, size.y);

  const DirectSources sources = find_direct_sources(world);
  ImageHandle direct = create(graph, "near direct light", receivers, VK_FORMAT_R32G32B32A32_SFLOAT);
  ComputePass& lit = trace_compute(graph, "many light: near direct", kernels::many_light_near_direct_comp, world);
  read_receivers(lit, near);
  read_direct_sources(lit, sources)
      .write("irradiance", direct)
      .push(glsl::NearDirectParams{size, sources.table_size, sources.emitter_count, sources.light_count, index,
                                   kDirect + sequences})
      .dispatch_threads(size.x, size.y);

  const bool has_indirect = depth + 1 < bounces;
  ImageHandle indirect;
  if (has_indirect) indirect = add_nearby(graph, g, near, gather(graph, g, near, depth + 1), depth + 1);
  ImageHandle sum = create(graph, "gathered light, near and far", receivers, VK_FORMAT_R32G32B32A32_SFLOAT);
  graph.compute("many light: add near", kernels::many_light_add_near_comp)
      .read("factor", factor)
      .read("near_direct", direct)
      .read("near_indirect", has_indirect ? indirect : direct)
      .read("far", far)
      .write("sum", sum)
      .constant("kIndirect", has_indirect ? 1 : 0)
      .push(glsl::AddParams{size})
      .dispatch_threads(size.x, size.y);
  return sum;
}

// For how many frames each block's history may count; empty where nothing has changed.
ImageHandle ManyLightBest::record_limits(FrameGraph& graph, const ManyLightWorld& world, ViewFrame& view,
                                         ImageHandle last_memory) const {
  if (!world.replayed_points()) return {};
  const GBuffer& gbuffer = view.gbuffer;
  const glm::uvec2 size(gbuffer.width, gbuffer.height);
  const glm::uvec2 blocks = change_blocks(size);
  const ImageDesc desc{.width = blocks.x, .height = blocks.y, .format = VK_FORMAT_R32G32B32A32_SFLOAT};
  const Reprojection& reprojection = view.reprojection();
  glsl::ChangeParams params{.size = size,
                            .block_count = blocks,
                            .clearance = pixel_clearance(view.camera),
                            .turn = change_turn(view.world.index)};
  set_clamp(make_clamp(view.world, options_.clamp), params);
  ImageHandle change = graph.create_image("light change", desc);
  ComputePass& pass = trace_compute(graph, "many light: change", kernels::many_light_change_comp, view.world);
  read_reprojection(pass, reprojection)
      .read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("face", gbuffer.face)
      .read("last_memory", last_memory)
      .read("last_points", world.last_points())
      .read("replayed_points", world.replayed_points())
      .write("change", change)
      .constant("kShadows", world.options().visibility == Visibility::kNone ? 0 : 1)
      .push(params)
      .dispatch_threads(blocks.x, blocks.y);
  return record_change_limits(graph, "many light: change", change);
}

// Counts frames that differ from the one before in nothing but the random numbers.
void ManyLightBest::note_changes(const ViewFrame& view) {
  const bool same =
      !view.is_cut() && revisions_ == view.world.revisions && camera_ == view.camera.steady_view_projection;
  revisions_ = view.world.revisions;
  camera_ = view.camera.steady_view_projection;
  steady_frames_ = same ? steady_frames_ + 1 : 0;
}

GiResult ManyLightBest::record_view(FrameGraph& graph, TechniqueWorld* world_part, ViewFrame& view) {
  const auto& part = *static_cast<ManyLightWorld*>(world_part);
  const Receivers receivers = receivers_of(view.gbuffer, pixel_clearance(view.camera));
  note_changes(view);
  ImagePair memory = graph.history_pair(
      "light memory", {.width = receivers.width, .height = receivers.height, .format = VK_FORMAT_R32G32B32A32_UINT});
  Gathering g{.part = part,
              .view = view,
              .learned = record_learned_visibility(graph),
              .tiles = {},
              .clamp = make_clamp(view.world, options_.clamp),
              .memory = memory.current};
  g.tiles = record_light_tiles(graph, receivers, part.clusters(), g.learned, g.clamp, cluster_bounds(view.world));
  const ImageHandle far = gather(graph, g, receivers, 0);
  const ImageHandle sampled = add_nearby(graph, g, receivers, far, 0);

  TemporalBlend blend{.most_frames = static_cast<float>(options_.history)};
  if (memory.valid && options_.history > 0) {
    blend.limits = record_limits(graph, part, view, memory.previous);
    blend.limit_block = glsl::kChangeBlock;
  }
  const TemporalMean mean = record_temporal_mean(graph, "indirect light", sampled, view.reprojection(), blend);
  if (!mean.has_history) steady_frames_ = 0;
  const ImageHandle filtered =
      options_.filter ? record_noise_filter(graph, "indirect light", mean, view.gbuffer, view.camera, kWideFilter)
                      : mean.mean;
  views_ = {{"sampled-indirect", sampled},
            {"far-indirect", far},
            {"mean-indirect", mean.mean},
            {"filtered-indirect", filtered}};
  add_world_views(graph, part, view, views_);
  views_.push_back({"history-limits", blend.limits ? blend.limits : mean.mean});
  return {.irradiance = filtered, .steady = options_.history == 0 || steady_frames_ + 1 >= kSteadyFrames};
}

}  // namespace lightwell
