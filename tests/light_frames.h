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
#include "passes/camera/camera.h"
#include "passes/combine/combine.h"
#include "passes/environment/gpu_environment.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/reprojection/reprojection.h"
#include "passes/sampled_lights/sampled_lights.h"
#include "passes/trace/tracer.h"

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
        gpu_scene_(device, scene_, world),
        environment_(device, scene_.environment),
        tracer_(device, Tracing::kBvh) {
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
  std::uint64_t index_ = 0;
  std::map<std::string, double> times_ms;  // by pass, of the last frame

 private:
  using Texels = std::vector<float>;

  std::map<std::string, Texels> run(const PixelSample& sample, bool film, bool first_of_film = true) {
    FrameGraph graph(executor_.context());
    const FrameGraph::Scope view = graph.enter("", reset);
    const glsl::GpuCamera gpu_camera = make_gpu_camera(camera, {side_, side_}, sample, reset ? nullptr : &last_camera_);
    last_camera_ = gpu_camera;
    const BufferHandle camera_handle = graph.upload("camera", std::span(&gpu_camera, 1));
    const GpuScene::Frame scene = gpu_scene_.record(graph, world);
    const ImageHandle environment = environment_.record(graph);
    const GBuffer gbuffer =
        record_gbuffer(graph, scene, camera_handle, environment, side_, side_, environment_.constant_radiance());
    const Tracer::Frame traced = tracer_.record(graph, scene);
    const Reprojection reprojection = record_reprojection(graph, gbuffer, gpu_camera);
    const SampledLights::Frame light =
        lights_.record(graph, gbuffer, scene, traced, reprojection, environment_, environment, gpu_camera, settings,
                       std::exchange(reset, false), index_++);
    steady = light.steady;
    std::map<std::string, ReadbackTicket> tickets;
    if (light.irradiance) {
      tickets["irradiance"] = graph.read_back(light.irradiance);
      tickets["mean"] = graph.read_back(light.mean);
    }
    if (film)
      tickets["direct"] =
          graph.read_back(record_film(graph, gbuffer, {light.irradiance, {}, {}}, first_of_film).images[0]);
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
  GpuScene gpu_scene_;
  GpuEnvironment environment_;
  Tracer tracer_;
  SampledLights lights_;
  glsl::GpuCamera last_camera_{};
  std::uint64_t frame_ = 0;
};

}  // namespace lightwell
