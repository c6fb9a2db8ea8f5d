#include "passes/trace/choose_tracing.h"

#include <cmath>
#include <cstdio>
#include <random>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "core/log.h"
#include "gpu/device.h"
#include "gpu/submit.h"
#include "graph/executor.h"
#include "graph/linear_dispatch.h"
#include "kernels/passes/trace/trace_rays.comp.h"
#include "passes/trace/trace_rays_types.h"

namespace lightwell {
namespace {

constexpr double kClearlyFaster = 1.5;
constexpr std::size_t kFewRays = 1024;
constexpr std::size_t kManyRays = 65536;  // a fast device is not busy with fewer
constexpr double kLongEnough_ms = 1.0;    // to be more than the start of a dispatch

// A unit ball of 2 * kRings * kSectors triangles in the order of rows, as meshes have them.
Primitive make_ball() {
  constexpr std::uint32_t kRings = 8;
  constexpr std::uint32_t kSectors = 16;
  Primitive ball;
  for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
    for (std::uint32_t sector = 0; sector <= kSectors; ++sector) {
      const float theta = glm::pi<float>() * static_cast<float>(ring) / kRings;
      const float phi = glm::two_pi<float>() * static_cast<float>(sector) / kSectors;
      ball.positions.push_back({std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)});
      if (ring == kRings || sector == kSectors) continue;
      const std::uint32_t corner = ring * (kSectors + 1) + sector;
      const std::uint32_t below = corner + kSectors + 1;
      ball.indices.insert(ball.indices.end(), {corner, below, corner + 1, corner + 1, below, below + 1});
    }
  }
  ball.normals = ball.positions;
  return ball;
}

// Sixteen balls, 4096 triangles, in a cube of two metres.
Scene make_scene(std::mt19937& random) {
  std::uniform_real_distribution<float> coordinate(-1.0f, 1.0f);
  Scene scene;
  scene.meshes.push_back({"ball", {make_ball()}, {}});
  for (int i = 0; i < 16; ++i) {
    Node& node = scene.nodes.emplace_back();
    node.mesh = 0;
    node.translation = {coordinate(random), coordinate(random), coordinate(random)};
    node.scale = glm::vec3(0.3f);
  }
  return scene;
}

std::vector<glsl::ListedRay> make_rays(std::mt19937& random) {
  std::uniform_real_distribution<float> coordinate(-1.0f, 1.0f);
  std::normal_distribution<float> normal;
  std::vector<glsl::ListedRay> rays(kManyRays);
  for (glsl::ListedRay& ray : rays)
    ray = {{coordinate(random), coordinate(random), coordinate(random)},
           0.0f,
           glm::normalize(glm::vec3(normal(random), normal(random), 2.0f)),
           1e30f};
  return rays;
}

// Traces rays through the scene, frame after frame.
class Stopwatch {
 public:
  Stopwatch(Device& device, Tracing tracing, const Scene& scene)
      : snapshot_(take_snapshot(scene)),
        scene_(device, scene, snapshot_),
        tracer_(device, tracing),
        executor_(device, 1),
        submitter_(device) {}

  // GPU time in ms.
  double time(std::span<const glsl::ListedRay> rays) {
    FrameGraph graph(executor_.context());
    const GpuScene::Frame scene = scene_.record(graph, snapshot_);
    const Tracer::Frame tracer = tracer_.record(graph, scene);
    BufferHandle hits = graph.create_buffer("hits", rays.size(), sizeof(glsl::ListedHit));
    dispatch_linear(trace_compute(graph, kPass, kernels::trace_trace_rays_comp, scene, tracer)
                        .read("rays", graph.upload("rays", rays))
                        .write("hits", hits)
                        .push(glsl::RayParams{static_cast<std::uint32_t>(rays.size()), 0}),
                    rays.size());
    submitter_.run([&](VkCommandBuffer commands) { frame_ = executor_.record(graph, commands, frame_); });
    for (const PassTime& pass : executor_.pass_times(frame_))
      if (pass.name == kPass) return pass.time_ms;
    return 0.0;
  }

 private:
  static constexpr const char* kPass = "trace rays";
  SceneSnapshot snapshot_;
  GpuScene scene_;
  Tracer tracer_;
  GraphExecutor executor_;
  Submitter submitter_;
  std::uint64_t frame_ = 0;
};

// Millions of rays a second.
double measure_rate(Device& device, Tracing tracing, const Scene& scene, std::span<const glsl::ListedRay> rays) {
  Stopwatch stopwatch(device, tracing, scene);
  stopwatch.time(rays.first(kFewRays));  // drivers compile in the first
  std::size_t count = kFewRays;
  double time_ms = stopwatch.time(rays.first(count));
  if (time_ms < kLongEnough_ms) {
    count = kManyRays;
    time_ms = stopwatch.time(rays.first(count));
  }
  return static_cast<double>(count) / (1e3 * time_ms);
}

bool is_ray_query_faster(Device& device) {
  if (device.is_lent()) return device.summary().type != "software";
  if (!device.has_timestamps()) return false;
  std::mt19937 random(1);
  const Scene scene = make_scene(random);
  const std::vector<glsl::ListedRay> rays = make_rays(random);
  const double own = measure_rate(device, Tracing::kBvh, scene, rays);
  const double ray_query = measure_rate(device, Tracing::kRayQuery, scene, rays);
  const bool faster = ray_query > kClearlyFaster * own;
  char text[128];
  std::snprintf(text, sizeof text, "tracing: %s (%.3g M rays/s; %s %.3g)", faster ? "ray queries" : "own hierarchy",
                faster ? ray_query : own, faster ? "own hierarchy" : "ray queries", faster ? own : ray_query);
  log_info(text);
  return faster;
}

}  // namespace

Tracing choose_tracing(Device& device) {
  if (!device.has_ray_query()) return Tracing::kBvh;
  if (!device.prefers_ray_query) device.prefers_ray_query = is_ray_query_faster(device);
  return *device.prefers_ray_query ? Tracing::kRayQuery : Tracing::kBvh;
}

}  // namespace lightwell
