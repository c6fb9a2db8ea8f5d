#include "apps/cli/bench_frames.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/memory_check.h"
#include "gpu/device.h"
#include "gpu/submit.h"
#include "lightwell/error.h"

namespace lightwell {

using Json = nlohmann::ordered_json;

namespace {

constexpr int kFramesPerRound = 30;    // of moving lights
constexpr float kRoundRadius = 0.05f;  // of the scene's diagonal; for directions: the tangent of their tilt

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

}  // namespace

BenchResult run_frames(const RenderJob& job, const BenchRun& run, const std::string& technique) {
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
  for (int frame = 0; frame < run.warm_up + run.frames; ++frame) {
    Moment moment = job.play ? job.play(frame) : job.start;
    if (run.moving_lights > 0) moment.world.lights = lights_at(moment.world, frame, run.moving_lights);
    FrameView view{.snapshot = &moment.world, .camera = moment.camera, .time = moment.time};
    view.cut = run.cut == BenchCut::kEvery || (run.cut == BenchCut::kFirst && frame == run.warm_up);
    const auto start = std::chrono::steady_clock::now();
    submitter.run([&](VkCommandBuffer commands) { last = renderer.record(commands, view, target, last).frame; });
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    if (frame >= run.warm_up) result.frames.push_back({wall.count(), renderer.statistics_of(last)});
  }
  if (!device.validation_messages().empty())
    throw InputError("--validation",
                     std::to_string(device.validation_messages().size()) + " messages of the validation layer");
  return result;
}

Json bench_as_json(const BenchResult& result) {
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

}  // namespace lightwell
