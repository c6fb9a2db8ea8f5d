// Runs the sampled direct light of a scene frame by frame, the way the renderer does.
#pragma once

#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gpu/submit.h"
#include "graph/executor.h"
#include "lightwell/scene.h"
#include "passes/combine/combine.h"
#include "passes/sampled_lights/sampled_lights.h"
#include "passes/view/view_frame.h"

namespace lightwell {

class LightFrames {
 public:
  // `view`: default: the scene's first camera.
  LightFrames(Device& device, Scene scene, std::uint32_t side, const SampledLights::Settings& settings = {},
              const std::optional<WorldCamera>& view = {})
      : world(take_snapshot(scene)),
        settings(settings),
        scene_(std::move(scene)),
        side_(side),
        executor_(device),
        submitter_(device),
        world_(device, scene_, world, {.tracing = Tracing::kBvh}) {
    camera = view ? *view : world.cameras.at(0);
  }

  // Irradiance (W/m^2) of the next frame, black where there is no surface.
  Image next() { return to_image(run({}, false)["irradiance"]); }

  // What the renderer's direct light is after `frames` frames and `samples` jittered ones: radiance, W/(sr m^2).
  Image direct(int frames, int samples) {
    for (int i = 0; i < frames; ++i) run({}, false);
    Image film;
    for (int i = 0; i < samples; ++i) {
      const float part = (static_cast<float>(i) + 0.5f) / static_cast<float>(samples);
      const PixelSample sample{{part - 0.5f, std::fmod(part * 0.5f * static_cast<float>(samples), 1.0f) - 0.5f},
                               1.0f / std::sqrt(static_cast<float>(samples))};
      film = to_image(run(sample, true, i == 0).at("direct"));
    }
    for (float& value : film.pixels) value /= static_cast<float>(samples);
    return film;
  }

  SceneSnapshot world;  // of the next frame
  WorldCamera camera;
  SampledLights::Settings settings;
  bool reset = true;  // the next frame knows nothing of the ones before
  bool steady = false;
  std::map<std::string, double> times_ms;  // by pass, of the last frame

 private:
  using Texels = std::vector<float>;

  std::map<std::string, Texels> run(const PixelSample& sample, bool film, bool first_of_film = true) {
    FrameGraph graph(executor_.context());
    const FrameGraph::Scope scope = graph.enter("", reset);
    WorldFrame world_frame(graph, world_, world, 0.0);
    ViewFrame view(graph, world_frame, {side_, side_}, camera, sample, reset ? nullptr : &last_camera_);
    last_camera_ = view.camera;
    reset = false;
    const SampledLights::Frame light = lights_.record(graph, view, settings);
    steady = light.steady;
    std::map<std::string, ReadbackTicket> tickets;
    if (light.irradiance) {
      tickets["irradiance"] = graph.read_back(light.irradiance);
      tickets["mean"] = graph.read_back(light.mean);
    }
    if (film)
      tickets["direct"] =
          graph.read_back(record_film(graph, view.gbuffer, {light.irradiance, {}, {}}, first_of_film).images[0]);
    submitter_.run([&](VkCommandBuffer commands) { frame_ = executor_.record(graph, commands, frame_); });
    times_ms.clear();
    for (const PassTime& pass : executor_.pass_times(frame_)) times_ms[pass.name] += pass.time_ms;
    std::map<std::string, Texels> texels;
    for (const auto& [name, ticket] : tickets) {
      const std::vector<std::byte> bytes = executor_.fetch(frame_, ticket);
      texels[name].resize(bytes.size() / sizeof(float));
      std::memcpy(texels[name].data(), bytes.data(), bytes.size());
    }
    return texels;
  }

  Image to_image(const Texels& texels) const {
    Image image(static_cast<int>(side_), static_cast<int>(side_));
    for (std::size_t i = 0; i < texels.size() / 4; ++i)
      for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = texels[4 * i + c];
    return image;
  }

  Scene scene_;
  std::uint32_t side_;
  GraphExecutor executor_;
  Submitter submitter_;
  World world_;
  SampledLights lights_;
  glsl::GpuCamera last_camera_{};
  std::uint64_t frame_ = 0;
};

}  // namespace lightwell
