#include "passes/world/world.h"

#include <utility>

#include <glm/common.hpp>

#include "gpu/device.h"
#include "passes/trace/choose_tracing.h"

namespace lightwell {
namespace {

// The world's histories bear no prefix, whoever uses a service first; a view's own cut does not concern them.
FrameGraph::Scope enter_world(FrameGraph& graph, bool cut) {
  return graph.enter("", cut);
}

Bounds bounds_of(std::span<const glm::vec3> points) {
  Bounds bounds{points.front(), points.front()};
  for (const glm::vec3& point : points) {
    bounds.minimum = glm::min(bounds.minimum, point);
    bounds.maximum = glm::max(bounds.maximum, point);
  }
  return bounds;
}

glm::vec3 middle_of(const Bounds& bounds) {
  return bounds.minimum + 0.5f * (bounds.maximum - bounds.minimum);
}

}  // namespace

World::World(Device& device, const Scene& scene, const SceneSnapshot& snapshot, const WorldOptions& options)
    : device_(device),
      options_(options),
      scene_(device, scene, snapshot),
      environment_(device, scene.environment),
      shadow_maps_(device) {}

Tracer& World::find_tracer() {
  if (!tracer_) tracer_.emplace(device_, options_.tracing ? *options_.tracing : choose_tracing(device_));
  return *tracer_;
}

WorldFrame::WorldFrame(FrameGraph& graph, World& world, const SceneSnapshot& world_snapshot, double world_time,
                       bool cut, std::span<const glm::vec3> points_of_interest)
    : snapshot(world_snapshot), time(world_time), is_cut(cut), graph_(graph), world_(world) {
  const FrameGraph::Scope scope = enter_world(graph, is_cut);
  scene = world.scene_.record(graph, snapshot);
  lights = world.lights_.record(graph, snapshot.lights);
  environment = world.environment_.record(graph);
  grid_bounds = world.options_.grid_bounds.value_or(snapshot.bounds);
  focus = middle_of(points_of_interest.empty() ? grid_bounds : bounds_of(points_of_interest));
  focus_balls = make_focus_balls(snapshot.bounds, focus, world.options_.grid_bounds,
                                 is_cut ? std::span<const FocusBall>() : world.last_focus_balls_);
  revisions = scene.revisions;
  revisions.lights = lights.revision;
  revisions.environment = world.environment_.revision();
  index = world.frames_++;
  time_step = time - world.last_time_.value_or(time);
  graph.on_recorded([&world, now = time, balls = focus_balls] {
    world.last_time_ = now;
    world.last_focus_balls_ = balls;
  });
}

std::uint32_t WorldFrame::largest_image() const {
  return world_.device_.limits().maxImageDimension2D;
}

const Tracer::Frame& WorldFrame::tracer() {
  const FrameGraph::Scope scope = enter_world(graph_, is_cut);
  if (!tracer_) tracer_ = world_.find_tracer().record(graph_, scene);
  return *tracer_;
}

const EmitterTable::Frame& WorldFrame::emitters() {
  const FrameGraph::Scope scope = enter_world(graph_, is_cut);
  if (!emitters_) emitters_ = world_.emitters_.record(graph_, scene);
  return *emitters_;
}

BufferHandle WorldFrame::environment_table() {
  if (!environment_table_) environment_table_ = world_.environment_.record_table(graph_);
  return *environment_table_;
}

const ShadowMaps::Frame& WorldFrame::shadows() {
  const FrameGraph::Scope scope = enter_world(graph_, is_cut);
  if (!shadows_)
    shadows_ = world_.shadow_maps_.record(graph_, scene, lights, snapshot.bounds, focus_balls,
                                          world_.options_.shadow_map_size);
  return *shadows_;
}

ComputePass& trace_compute(FrameGraph& graph, std::string_view name, const TraceKernel& kernel, WorldFrame& world) {
  const Tracer::Frame& tracer = world.tracer();
  return trace_compute(graph, name, kernel, world.scene, tracer);
}

}  // namespace lightwell
