#include "apps/cli/bench_flight.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/animation_arguments.h"
#include "apps/cli/bench_frames.h"
#include "apps/cli/bench_tables.h"
#include "apps/cli/flight_points.h"
#include "apps/cli/memory_check.h"
#include "apps/cli/scene_arguments.h"
#include "apps/cli/technique_arguments.h"
#include "apps/cli/text.h"
#include "gpu/device.h"
#include "gpu/submit.h"
#include "graph/executor.h"
#include "lightwell/error.h"
#include "renderer/view.h"

namespace lightwell {

namespace {

using Json = nlohmann::ordered_json;

constexpr float kFloor = 0.01f;  // of the mean of all places: below it changes are measured against this
constexpr int kMostPoints = 1 << 20;

struct Arguments {
  SceneArguments scene;
  CameraArguments camera;
  AnimationArguments animation;
  TechniqueArguments technique;
  std::string frames = "120", warm_up = "64", points = "1000", rays = "256", bounces = "1024", seed = "1";
  bool json = false;
};

struct FlightFrame {
  std::vector<float> irradiance;  // of each place, W/m^2, mean of the channels
  double wall_ms = 0.0, gpu_ms = 0.0;
  std::uint64_t memory_bytes = 0;
};

// Renders frames of a view, and looks up the places in each.
class Flight {
 public:
  Flight(Device& device, const RenderJob& job, const RendererOptions& options,
         std::span<const glsl::SurfacePoint> points)
      : device_(device),
        points_(points),
        executor_(device),
        submitter_(device),
        world_(device, job.scene, job.start.world, options),
        view_(world_, "", options) {
    if (!view_.technique_world()) throw InputError("--technique", options.technique + " has no light off the screen");
  }

  FlightFrame next(const Moment& moment) {
    const auto start = std::chrono::steady_clock::now();
    FrameGraph graph(executor_.context());
    WorldFrame world(graph, world_.world(), moment.world, moment.time, false, {&moment.camera.position, 1});
    const DeclaredView declared = view_.declare(graph, world, moment.camera, false, {});
    const ReadbackTicket picture = graph.read_back(record_combine(graph, declared.gbuffer, declared.parts));
    const ReadbackTicket ticket = look_up(graph, world);
    submitter_.run([&](VkCommandBuffer commands) { frame_ = executor_.record(graph, commands, frame_); });
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    executor_.fetch(frame_, picture);
    FlightFrame frame{.irradiance = fetch(ticket), .wall_ms = wall.count()};
    for (const PassTime& pass : executor_.pass_times(frame_)) frame.gpu_ms += pass.time_ms;
    for (const auto& [name, use] : device_.memory().report()) frame.memory_bytes += use.bytes;
    return frame;
  }

 private:
  ReadbackTicket look_up(FrameGraph& graph, WorldFrame& world) {
    const FrameGraph::Scope scope = graph.enter("points: ", false);
    const Points list{graph.upload<glsl::SurfacePoint>("points", points_), static_cast<std::uint32_t>(points_.size())};
    const BufferHandle irradiance = view_.technique_world()->record_points(graph, world, list);
    if (!irradiance) throw InputError("--technique", "this one and its preset have no light off the screen");
    return graph.read_back(irradiance);
  }

  std::vector<float> fetch(const ReadbackTicket& ticket) {
    const std::vector<std::byte> bytes = executor_.fetch(frame_, ticket);
    std::vector<glm::vec4> values(bytes.size() / sizeof(glm::vec4));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    std::vector<float> means;
    for (const glm::vec4& value : values) means.push_back((value.x + value.y + value.z) / 3.0f);
    return means;
  }

  Device& device_;
  std::span<const glsl::SurfacePoint> points_;
  GraphExecutor executor_;
  Submitter submitter_;
  SharedWorld world_;
  View view_;
  std::uint64_t frame_ = 0;
};

double mean(const auto& values) {
  double sum = 0.0;
  for (const auto value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double percentile(std::vector<double> values, double part) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(part * static_cast<double>(values.size())))];
}

// Of every place from each frame to the next, relative to the larger of both.
std::vector<double> changes_between(const FlightFrame& a, const FlightFrame& b, double floor) {
  std::vector<double> changes;
  for (std::size_t i = 0; i < a.irradiance.size(); ++i) {
    const double before = a.irradiance[i], now = b.irradiance[i];
    changes.push_back(std::abs(now - before) / std::max({before, now, floor, 1e-30}));
  }
  return changes;
}

Json as_json(const std::vector<FlightFrame>& frames, const FlightPlaces& places) {
  const double truth = mean(places.irradiance);
  const auto error = [&](const FlightFrame& frame) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < frame.irradiance.size(); ++i)
      errors.push_back(std::abs(frame.irradiance[i] - places.irradiance[i]));
    return truth > 0.0 ? mean(errors) / truth : 0.0;
  };
  std::vector<double> changes, wall, gpu;
  Json each = Json::array();
  std::uint64_t most_memory = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FlightFrame& frame = frames[i];
    wall.push_back(frame.wall_ms);
    gpu.push_back(frame.gpu_ms);
    most_memory = std::max(most_memory, frame.memory_bytes);
    Json row = {{"energy", truth > 0.0 ? mean(frame.irradiance) / truth : 0.0},
                {"wall_ms", frame.wall_ms},
                {"gpu_ms", frame.gpu_ms},
                {"memory_bytes", frame.memory_bytes}};
    if (i > 0) {
      const std::vector<double> now = changes_between(frames[i - 1], frame, kFloor * truth);
      row["largest_change"] = percentile(now, 1.0);
      changes.insert(changes.end(), now.begin(), now.end());
    }
    each.push_back(row);
  }
  const auto times = [](const std::vector<double>& ms) {
    return Json{{"median", percentile(ms, 0.5)}, {"mean", mean(ms)}, {"max", percentile(ms, 1.0)}};
  };
  return {{"frames", frames.size()},
          {"points", places.points.size()},
          {"true_irradiance", truth},
          {"truth_noise", truth > 0.0 ? mean(places.noise) / truth : 0.0},
          {"changes",
           {{"p50", percentile(changes, 0.5)},
            {"p99", percentile(changes, 0.99)},
            {"p999", percentile(changes, 0.999)},
            {"max", percentile(changes, 1.0)}}},
          {"energy", {{"first", each.front()["energy"]}, {"last", each.back()["energy"]}}},
          {"error", {{"first", error(frames.front())}, {"last", error(frames.back())}}},
          {"memory_bytes",
           {{"first", frames.front().memory_bytes}, {"last", frames.back().memory_bytes}, {"most", most_memory}}},
          {"wall_ms", times(wall)},
          {"gpu_ms", times(gpu)},
          {"each", each}};
}

void print(const Json& json) {
  const auto number = [&](const char* group, const char* name) { return json[group][name].get<double>(); };
  std::printf("%d frames, %d points\n", json["frames"].get<int>(), json["points"].get<int>());
  std::printf("change of irradiance a frame: median %.3f %%, 99th percentile %.2f %%, 99.9th %.2f %%, most %.2f %%\n",
              100.0 * number("changes", "p50"), 100.0 * number("changes", "p99"), 100.0 * number("changes", "p999"),
              100.0 * number("changes", "max"));
  std::printf("energy: first frame %.4f, last %.4f of the path tracer's\n", number("energy", "first"),
              number("energy", "last"));
  std::printf("error, mean distance from the path tracer over its mean: first frame %.3f, last %.3f; its noise %.3f\n",
              number("error", "first"), number("error", "last"), json["truth_noise"].get<double>());
  constexpr double kMebibyte = 1 << 20;
  std::printf("memory, MiB: first frame %.1f, last %.1f\n", number("memory_bytes", "first") / kMebibyte,
              number("memory_bytes", "last") / kMebibyte);
  std::printf("frame, ms: median %.2f, slowest %.2f; on the device %.2f and %.2f\n", number("wall_ms", "median"),
              number("wall_ms", "max"), number("gpu_ms", "median"), number("gpu_ms", "max"));
}

void bench_flight(const Arguments& arguments) {
  const int frame_count = parse_integer("--frames", arguments.frames, 2, kMaximumBenchFrames);
  const int warm_up = parse_integer("--warm-up", arguments.warm_up, 1, kMaximumBenchFrames);
  const int points = parse_integer("--points", arguments.points, 1, kMostPoints);
  const int rays = parse_integer("--rays", arguments.rays, 1, 1 << 20);
  const int bounces = parse_integer("--bounces", arguments.bounces, 1, 1024);
  const auto seed = static_cast<std::uint32_t>(parse_integer("--seed", arguments.seed, 0, 1 << 30));
  const ChosenTechnique chosen = choose_technique(arguments.technique);
  if (!chosen.method.on_gpu) throw InputError("--technique", chosen.method.name + " runs no frames on a device");
  const Scene scene = load_scene(arguments.scene);
  const Playback playback(scene, arguments.scene, arguments.camera, arguments.animation);
  const RenderJob job = make_job(arguments.technique, chosen, scene, playback.frame(0));
  const FlightPlaces places = find_flight_places(
      scene, [&](int frame) { return playback.frame(frame); }, frame_count, points, rays, bounces, seed);

  Device device({job.gpu.device, job.gpu.validation});
  check_frame_memory({job.width, job.height}, device);
  Flight flight(device, job, renderer_options(job, chosen.method.name), places.points);
  for (int frame = 0; frame < warm_up; ++frame) flight.next(job.start);
  std::vector<FlightFrame> frames;
  for (int frame = 0; frame < frame_count; ++frame) frames.push_back(flight.next(playback.frame(frame)));
  if (!device.validation_messages().empty())
    throw InputError("--validation",
                     std::to_string(device.validation_messages().size()) + " messages of the validation layer");
  const Json json = as_json(frames, places);
  if (arguments.json)
    std::printf("%s\n", json.dump(2).c_str());
  else
    print(json);
}

}  // namespace

void add_bench_flight_command(CLI::App& bench) {
  CLI::App* command = bench.add_subcommand(
      "flight", "Fly the camera along its animation: how steady light at fixed points is, memory, times");
  const auto arguments = std::make_shared<Arguments>();
  arguments->technique.size = "64x64";
  add_scene_options(*command, arguments->scene);
  add_camera_options(*command, arguments->camera);
  add_animation_options(*command, arguments->animation);
  command->add_option("--frames", arguments->frames, "Frames of the flight, each 1 / --fps after the last (120)");
  command->add_option("--warm-up", arguments->warm_up, "Frames at its start before (64)");
  command->add_option("--points", arguments->points, "Fixed places on surfaces along the path (1000)");
  command->add_option("--rays", arguments->rays, "Paths of the path tracer at each place (256)");
  command->add_option("--bounces", arguments->bounces,
                      "Bounces of these, at most: as many as the technique shows (1024, which chance ends before)");
  command->add_option("--seed", arguments->seed, "Of the places (1)");
  command->add_flag("--json", arguments->json, "Print JSON");
  add_technique_options(*command, arguments->technique);
  command->footer("");  // not that of `bench`
  command->callback([arguments, command, &bench] {
    refuse_options_of_bench(bench, *command);
    bench_flight(*arguments);
  });
}

}  // namespace lightwell
