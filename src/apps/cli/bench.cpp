// lightwell bench: what frames cost, one by one, with nothing brought back from the device.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <span>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/animation_arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/memory_check.h"
#include "apps/cli/scene_arguments.h"
#include "apps/cli/technique_arguments.h"
#include "apps/cli/text.h"
#include "gpu/device.h"
#include "gpu/submit.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

using Json = nlohmann::ordered_json;

struct BenchArguments {
  SceneArguments scene;
  CameraArguments camera;
  AnimationArguments animation;
  TechniqueArguments technique;
  std::string frames = "30", warm_up = "3";
  std::string cut = "none";
  bool move_lights = false;
  bool move_light = false;
  bool animate = false;
  bool json = false;
};

constexpr int kFramesPerRound = 30;    // of moving lights
constexpr float kRoundRadius = 0.05f;  // of the scene's diagonal; for directions: the tangent of their tilt
constexpr int kMaximumBenchFrames = 100000;

// The first `count` lights on a circle: points and spots in the horizontal plane through the place they had, directions
// round the one they had. No two frames of a round are alike.
std::vector<WorldLight> lights_at(const SceneSnapshot& rest, int frame, std::size_t count) {
  const float angle = glm::two_pi<float>() * static_cast<float>(frame % kFramesPerRound) / kFramesPerRound;
  const float radius = kRoundRadius * glm::length(rest.bounds.maximum - rest.bounds.minimum);
  std::vector<WorldLight> lights = rest.lights;
  for (WorldLight& light : std::span(lights).first(std::min(count, lights.size()))) {
    if (light.type != LightType::kDirectional) {
      light.position += radius * glm::vec3(std::cos(angle), 0.0f, std::sin(angle));
      continue;
    }
    const glm::vec3 away = std::abs(light.direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 u = glm::normalize(glm::cross(away, light.direction));
    const glm::vec3 v = glm::cross(light.direction, u);
    light.direction = glm::normalize(light.direction + kRoundRadius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return lights;
}

struct FrameCost {
  double wall_ms = 0.0;  // declare, record, submit, wait
  RenderStatistics statistics;
};

struct BenchResult {
  std::string device, driver;
  std::vector<FrameCost> frames;  // without those of the warm-up
};

BenchResult run_frames(const RenderJob& job, const BenchArguments& arguments, const std::string& technique) {
  const int frames = parse_integer("--frames", arguments.frames, 1, kMaximumBenchFrames);
  const int warm_up = parse_integer("--warm-up", arguments.warm_up, 0, kMaximumBenchFrames);
  Device device({job.gpu.device, job.gpu.validation});
  check_frame_memory({job.width, job.height}, device);
  Renderer renderer(device, job.scene, job.start.world, renderer_options(job, technique));
  Submitter submitter(device);
  constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;
  ImageResource picture(device, "bench target",
                        {.format = kFormat,
                         .width = static_cast<std::uint32_t>(job.width),
                         .height = static_cast<std::uint32_t>(job.height)});
  RenderTarget target{.image = picture.handle(), .format = kFormat, .layout_after = VK_IMAGE_LAYOUT_GENERAL};

  BenchResult result{device.summary().name, device.summary().driver, {}};
  std::uint64_t last = 0;
  for (int frame = 0; frame < warm_up + frames; ++frame) {
    Moment moment = job.play ? job.play(frame) : job.start;
    if (arguments.move_lights || arguments.move_light)
      moment.world.lights = lights_at(moment.world, frame, arguments.move_lights ? moment.world.lights.size() : 1);
    FrameView view{.snapshot = &moment.world, .camera = moment.camera, .time = moment.time};
    view.cut = arguments.cut == "every" || (arguments.cut == "first" && frame == warm_up);
    const auto start = std::chrono::steady_clock::now();
    submitter.run([&](VkCommandBuffer commands) { last = renderer.record(commands, view, target, last).frame; });
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    if (frame >= warm_up) result.frames.push_back({wall.count(), renderer.statistics_of(last)});
  }
  if (!device.validation_messages().empty())
    throw InputError("--validation",
                     std::to_string(device.validation_messages().size()) + " messages of the validation layer");
  return result;
}

Json summary(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  double sum = 0.0;
  for (const double value : values) sum += value;
  return {{"min", values.front()},
          {"median", (values[(n - 1) / 2] + values[n / 2]) / 2},
          {"mean", sum / static_cast<double>(n)},
          {"max", values.back()}};
}

// A pass that some frames lack took no time in those: the means add up to the frame's.
Json pass_summaries(const std::vector<FrameCost>& frames) {
  Json passes = Json::array();
  std::vector<std::string> names;
  for (const FrameCost& frame : frames)
    for (const PassStatistics& pass : frame.statistics.passes)
      if (std::find(names.begin(), names.end(), pass.name) == names.end()) names.push_back(pass.name);
  for (const std::string& name : names) {
    std::vector<double> times;
    std::uint32_t count = 0;
    int present = 0;
    for (const FrameCost& frame : frames) {
      const std::vector<PassStatistics>& all = frame.statistics.passes;
      const auto pass = std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.name == name; });
      times.push_back(pass == all.end() ? 0.0 : pass->time_ms);
      if (pass == all.end()) continue;
      count = std::max(count, pass->count);
      ++present;
    }
    passes.push_back(
        {{"name", name}, {"count", count}, {"frames", present}, {"ms", summary(times)}, {"each_ms", times}});
  }
  return passes;
}

Json as_json(const BenchResult& result) {
  const RenderStatistics& last = result.frames.back().statistics;
  std::vector<double> wall, gpu;
  for (const FrameCost& frame : result.frames) {
    wall.push_back(frame.wall_ms);
    gpu.push_back(frame.statistics.gpu_time_ms);
  }
  Json memory = Json::array();
  std::uint64_t bytes = 0;
  for (const auto& [name, size] : last.memory_bytes) {
    memory.push_back({{"name", name}, {"bytes", size}});
    bytes += size;
  }
  return {{"device", result.device},
          {"driver", result.driver},
          {"frames", result.frames.size()},
          {"wall_ms", summary(wall)},
          {"gpu_ms", summary(gpu)},
          {"triangles", last.triangles},
          {"vertices", last.vertices},
          {"lights", last.lights},
          {"memory_bytes", bytes},
          {"passes", pass_summaries(result.frames)},
          {"memory", memory}};
}

void print_row(const std::string& name, const Json& ms, const std::string& more = "") {
  std::printf("%-32.32s %9.3f %9.3f %9.3f %9.3f  %s\n", name.c_str(), ms["min"].get<double>(),
              ms["median"].get<double>(), ms["mean"].get<double>(), ms["max"].get<double>(), more.c_str());
}

void print_table(const Json& json) {
  std::printf("%s (%s): %d frames, %.1f MiB\n", json["device"].get<std::string>().c_str(),
              json["driver"].get<std::string>().c_str(), json["frames"].get<int>(),
              json["memory_bytes"].get<double>() / (1 << 20));
  std::printf("%-32s %9s %9s %9s %9s  %s\n", "ms", "min", "median", "mean", "max", "count");
  print_row("frame, wall", json["wall_ms"]);
  print_row("frame, device", json["gpu_ms"]);
  for (const Json& pass : json["passes"])
    print_row("  " + pass["name"].get<std::string>(), pass["ms"], std::to_string(pass["count"].get<int>()));
  std::printf("%-32s %9s\n", "memory", "MiB");
  for (const Json& entry : json["memory"])
    std::printf("  %-30.30s %9.3f\n", entry["name"].get<std::string>().c_str(),
                entry["bytes"].get<double>() / (1 << 20));
}

void bench(const BenchArguments& arguments) {
  const ChosenTechnique chosen = choose_technique(arguments.technique);
  if (!chosen.method.on_gpu) throw InputError("--technique", chosen.method.name + " runs no frames on a device");
  const Scene scene = load_scene(arguments.scene);
  const Playback playback(scene, arguments.scene, arguments.camera, arguments.animation);
  RenderJob job = make_job(arguments.technique, chosen, scene, playback.looped_frame(0));
  if (arguments.animate) {
    if (!playback.is_animated())
      throw InputError("--animate", "the scene " + arguments.scene.scene + " has no animation");
    job.play = [&](int frame) { return playback.looped_frame(frame); };
  }
  const Json json = as_json(run_frames(job, arguments, chosen.method.name));
  if (arguments.json)
    std::printf("%s\n", json.dump(2).c_str());
  else
    print_table(json);
}

}  // namespace

void add_bench_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("bench", "Measure what frames cost: time by pass, wall time, memory");
  const auto arguments = std::make_shared<BenchArguments>();
  add_scene_options(*command, arguments->scene);
  add_camera_options(*command, arguments->camera);
  add_animation_options(*command, arguments->animation);
  command->add_option("--frames", arguments->frames, "Frames that are measured (30)");
  command->add_option("--warm-up", arguments->warm_up, "Frames before, not measured: drivers compile in them (3)");
  command->add_flag("--move-lights", arguments->move_lights,
                    "Lights circle by 5 % of the scene's diagonal, suns tilt: one round in 30 frames");
  command->add_flag("--move-light", arguments->move_light, "The same with the first light alone");
  command->add_flag("--animate", arguments->animate,
                    "Play the animation over and over: each frame is 1 / --fps later than the one before");
  command
      ->add_option("--cut", arguments->cut,
                   "Which measured frames start from nothing, as after a camera cut: none, first or every (none)")
      ->check(CLI::IsMember({"none", "first", "every"}));
  command->add_flag("--json", arguments->json, "Print JSON");
  add_technique_options(*command, arguments->technique);
  command->callback([arguments] { bench(*arguments); });
}

}  // namespace lightwell
