// lightwell rays: how many rays a second our hierarchy answers beside Embree, and what it costs to build.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/ray_lists.h"
#include "apps/cli/scene_arguments.h"
#include "apps/cli/text.h"
#include "gpu/device.h"
#include "gpu/submit.h"
#include "graph/executor.h"
#include "graph/linear_dispatch.h"
#include "kernels/passes/trace/trace_rays.comp.h"
#include "passes/trace/trace_rays_types.h"
#include "passes/trace/tracer.h"

namespace lightwell {
namespace {

using Json = nlohmann::ordered_json;

struct RaysArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::string rays = "1000000", repeat = "3";
  std::string device;
  bool json = false;
};

constexpr int kMaximumRays = 4000000;  // 128 MiB of rays

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// One scene on one device, traced by one kind of hierarchy.
class DeviceRays {
 public:
  DeviceRays(Device& device, const Scene& scene, const SceneSnapshot& snapshot, Tracing tracing)
      : snapshot_(snapshot),
        gpu_scene_(device, scene, snapshot),
        tracer_(device, tracing),
        executor_(device),
        submitter_(device) {}

  // Device time of bringing the hierarchy up to a frame in which all triangles may move: the first time it is built,
  // the next times refitted.
  double update_ms() {
    FrameGraph graph(executor_.context());
    GpuScene::Frame frame = gpu_scene_.record(graph, snapshot_);
    frame.moving_first = 0;
    frame.moving_count = frame.triangle_count;
    frame.revisions.moving_geometry = ++revision_;
    tracer_.record(graph, frame);
    run(graph);
    double ms = 0.0;
    for (const PassTime& pass : executor_.pass_times(last_))
      if (pass.name != "world vertices" && !pass.name.starts_with("upload ")) ms += pass.time_ms;
    return ms;
  }

  struct Answer {
    double ms = 0.0;
    std::size_t hits = 0;
  };

  Answer trace(const std::vector<glsl::ListedRay>& rays, BatchQuery query) {
    FrameGraph graph(executor_.context());
    const GpuScene::Frame frame = gpu_scene_.record(graph, snapshot_);
    const Tracer::Frame hierarchy = tracer_.record(graph, frame);
    BufferHandle hits = graph.create_buffer("hits", rays.size(), sizeof(glsl::ListedHit));
    const glsl::RayParams params{static_cast<std::uint32_t>(rays.size()), query == BatchQuery::kAnyHit ? 1u : 0u};
    dispatch_linear(trace_compute(graph, "trace rays", kernels::trace_trace_rays_comp, frame, hierarchy)
                        .read("rays", graph.upload<glsl::ListedRay>("rays", rays))
                        .write("hits", hits)
                        .push(params),
                    rays.size());
    const ReadbackTicket ticket = graph.read_back(hits);
    run(graph);
    Answer answer;
    for (const PassTime& pass : executor_.pass_times(last_))
      if (pass.name == "trace rays") answer.ms = pass.time_ms;
    const std::vector<std::byte> bytes = executor_.fetch(last_, ticket);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      glsl::ListedHit hit;
      std::memcpy(&hit, bytes.data() + i * sizeof(hit), sizeof(hit));
      answer.hits += hit.triangle != 0xffffffffu ? 1 : 0;
    }
    return answer;
  }

 private:
  void run(FrameGraph& graph) {
    submitter_.run([&](VkCommandBuffer commands) { last_ = executor_.record(graph, commands, last_); });
  }

  const SceneSnapshot& snapshot_;
  GpuScene gpu_scene_;
  Tracer tracer_;
  GraphExecutor executor_;
  Submitter submitter_;
  std::uint64_t last_ = 0;
  std::uint64_t revision_ = 0;
};

std::vector<glsl::ListedRay> to_device(const std::vector<BatchRay>& rays) {
  std::vector<glsl::ListedRay> listed;
  listed.reserve(rays.size());
  for (const BatchRay& ray : rays) listed.push_back({ray.origin, 0.0f, ray.direction, ray.t_max});
  return listed;
}

// Median rates of `repeat` runs, alternating, after one that is not counted: drivers compile in it.
Json compare(DeviceRays& device, const std::string& tracing, const RayTracer& embree, const RayList& list,
             BatchQuery query, int repeat) {
  const std::vector<glsl::ListedRay> listed = to_device(list.rays);
  std::vector<double> ours, theirs;
  DeviceRays::Answer answer = device.trace(listed, query);
  std::size_t their_hits = trace_batch(embree, list.rays, query);
  for (int i = 0; i < repeat; ++i) {
    answer = device.trace(listed, query);
    ours.push_back(answer.ms);
    const auto start = std::chrono::steady_clock::now();
    their_hits = trace_batch(embree, list.rays, query);
    theirs.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  const double count = static_cast<double>(list.rays.size());
  const double our_rate = count / median(ours) * 1e3;
  const double their_rate = count / median(theirs) * 1e3;
  return {{"tracing", tracing},
          {"rays", list.name},
          {"query", query == BatchQuery::kAnyHit ? "any hit" : "closest hit"},
          {"count", list.rays.size()},
          {"rays_per_s", our_rate},
          {"embree_rays_per_s", their_rate},
          {"ratio", our_rate / their_rate},
          {"hits", answer.hits},
          {"embree_hits", their_hits}};
}

// Medians, after one run that is not counted.
Json measure_updates(Device& device, const Scene& scene, const SceneSnapshot& snapshot, const std::string& name,
                     Tracing tracing, int repeat) {
  std::vector<double> builds, refits;
  for (int i = 0; i <= repeat; ++i) {
    DeviceRays moving(device, scene, snapshot, tracing);
    const double build = moving.update_ms();
    const double refit = moving.update_ms();
    if (i == 0) continue;
    builds.push_back(build);
    refits.push_back(refit);
  }
  return {{"tracing", name}, {"build_ms", median(builds)}, {"refit_ms", median(refits)}};
}

Json measure(const RaysArguments& arguments) {
  const int count = parse_integer("--rays", arguments.rays, 1, kMaximumRays);
  const int repeat = parse_integer("--repeat", arguments.repeat, 1, 100);
  const Scene scene = load_scene(arguments.scene);
  const SceneSnapshot snapshot = take_snapshot(scene);
  const WorldCamera camera = choose_camera(scene, snapshot, arguments.camera);
  const FlatScene flat = flatten(scene, snapshot);
  const auto start = std::chrono::steady_clock::now();
  const RayTracer embree(flat);
  const std::chrono::duration<double, std::milli> embree_build = std::chrono::steady_clock::now() - start;
  const std::vector<RayList> lists = make_ray_lists(camera, embree, count);

  Device device({arguments.device, false});
  std::vector<std::pair<std::string, Tracing>> tracings{{"bvh", Tracing::kBvh}};
  if (device.has_ray_query()) tracings.emplace_back("ray queries", Tracing::kRayQuery);
  Json structures = Json::array();
  Json rates = Json::array();
  for (const auto& [name, tracing] : tracings) {
    structures.push_back(measure_updates(device, scene, snapshot, name, tracing, repeat));
    DeviceRays traced(device, scene, snapshot, tracing);
    for (const RayList& list : lists)
      for (const BatchQuery query : {BatchQuery::kAnyHit, BatchQuery::kClosestHit})
        if (!list.rays.empty()) rates.push_back(compare(traced, name, embree, list, query, repeat));
  }
  return {{"device", device.summary().name},
          {"driver", device.summary().driver},
          {"cores", std::thread::hardware_concurrency()},
          {"triangles", flat.triangles.size()},
          {"embree_build_ms", embree_build.count()},
          {"structures", structures},
          {"rates", rates}};
}

void print_table(const Json& json) {
  std::printf("%s (%s), %d cores: %d triangles\n", json["device"].get<std::string>().c_str(),
              json["driver"].get<std::string>().c_str(), json["cores"].get<int>(), json["triangles"].get<int>());
  for (const Json& row : json["structures"])
    std::printf("%s: build %.1f ms, refit %.1f ms\n", row["tracing"].get<std::string>().c_str(),
                row["build_ms"].get<double>(), row["refit_ms"].get<double>());
  std::printf("Embree: build %.1f ms\n", json["embree_build_ms"].get<double>());
  std::printf("%-12s %-8s %-12s %12s %12s %8s %10s %10s\n", "by", "rays", "query", "rays/s", "Embree's", "ratio",
              "hits", "Embree's");
  for (const Json& row : json["rates"])
    std::printf("%-12s %-8s %-12s %12.0f %12.0f %8.3f %10d %10d\n", row["tracing"].get<std::string>().c_str(),
                row["rays"].get<std::string>().c_str(), row["query"].get<std::string>().c_str(),
                row["rays_per_s"].get<double>(), row["embree_rays_per_s"].get<double>(), row["ratio"].get<double>(),
                row["hits"].get<int>(), row["embree_hits"].get<int>());
}

}  // namespace

void add_rays_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("rays", "Measure ray tracing: rays a second beside Embree's, build time");
  const auto arguments = std::make_shared<RaysArguments>();
  add_scene_options(*command, arguments->scene);
  add_camera_options(*command, arguments->camera);
  command->add_option("--rays", arguments->rays, "Rays of each kind (1000000)");
  command->add_option("--repeat", arguments->repeat, "Runs whose median counts (3)");
  command->add_option("--device", arguments->device, "best, cpu, a part of a device's name or its number (best)");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->callback([arguments] {
    const Json json = measure(*arguments);
    if (arguments->json)
      std::printf("%s\n", json.dump(2).c_str());
    else
      print_table(json);
  });
}

}  // namespace lightwell
