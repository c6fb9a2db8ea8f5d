// Runs a preset on a scene, frame by frame, the way the renderer does.
#pragma once

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "gpu/submit.h"
#include "graph/executor.h"
#include "graph/testing/device_test.h"
#include "lightwell/scene.h"
#include "passes/camera/camera.h"
#include "passes/direct/direct.h"
#include "passes/environment/gpu_environment.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/lights/light_table.h"
#include "passes/shadow_maps/shadow_maps.h"
#include "techniques/light_volume/surfel_passes.h"
#include "techniques/light_volume/surfel_solver.h"

namespace lightwell {

// RGBA of every pixel.
struct SurfelPicture {
  std::vector<glm::vec4> irradiance;  // of the technique
  std::vector<glm::vec4> direct;      // irradiance of the lights
  std::vector<glm::vec4> position;    // w: 0 where there is no surface
  std::vector<glm::vec4> normal;
  std::vector<glm::vec4> albedo;
  std::map<std::string, double> times_ms;  // by pass
  bool steady = false;
};

class SurfelFrames {
 public:
  SurfelFrames(Device& device, Scene scene, const LightVolumeBestOptions& options, std::uint32_t side = 64)
      : SurfelFrames(device, std::move(scene), std::make_unique<LightVolumeBest>(options), side) {}

  SurfelFrames(Device& device, Scene scene, std::unique_ptr<Technique> technique, std::uint32_t side)
      : world(take_snapshot(scene)),
        scene_(std::move(scene)),
        side_(side),
        executor_(device),
        submitter_(device),
        gpu_scene_(device, scene_, world),
        environment_(device, scene_.environment),
        shadow_maps_(device),
        technique_(std::move(technique)) {
    camera = world.cameras.empty() ? default_camera(world.bounds) : world.cameras[0];
    grid_bounds = world.bounds;
  }

  SurfelPicture next() {
    FrameGraph graph(executor_.context());
    const glsl::GpuCamera gpu_camera = make_gpu_camera(camera, {side_, side_}, PixelSample{}, nullptr);
    FrameInputs inputs;
    inputs.world = &world;
    inputs.grid_bounds = grid_bounds;
    inputs.reset = std::exchange(reset, false);
    inputs.samples_sources = samples_sources;
    inputs.camera = graph.upload("camera", std::span(&gpu_camera, 1));
    inputs.scene = gpu_scene_.record(graph, world);
    inputs.revisions = inputs.scene.revisions;
    inputs.environment = environment_.record(graph);
    inputs.lights = lights_.record(graph, world.lights);
    inputs.shadows = shadow_maps_.record(graph, inputs.scene, inputs.lights, world.bounds, grid_bounds, 512);
    inputs.gbuffer = record_gbuffer(graph, inputs.scene, inputs.camera, inputs.environment, side_, side_);
    const ImageHandle direct = record_direct(graph, inputs.gbuffer, inputs.lights, inputs.shadows);
    const GiResult result = technique_->record(graph, inputs);
    std::vector<ReadbackTicket> tickets;
    for (const ImageHandle image : {result.irradiance, direct, inputs.gbuffer.position})
      tickets.push_back(graph.read_back(image));
    for (const ImageHandle image : {inputs.gbuffer.normal, inputs.gbuffer.albedo})
      tickets.push_back(graph.read_back(image));
    submitter_.run([&](VkCommandBuffer commands) { frame_ = executor_.record(graph, commands, frame_); });

    SurfelPicture picture{.irradiance = fetch<glm::vec4>(tickets[0]),
                          .direct = fetch<glm::vec4>(tickets[1]),
                          .position = fetch<glm::vec4>(tickets[2]),
                          .normal = to_floats(fetch<std::uint64_t>(tickets[3])),
                          .albedo = to_floats(fetch<std::uint64_t>(tickets[4])),
                          .times_ms = {},
                          .steady = result.steady};
    for (const PassTime& pass : executor_.pass_times(frame_)) picture.times_ms[pass.name] += pass.time_ms;
    return picture;
  }

  SurfelPicture run_until_steady(int most_frames = 200) {
    SurfelPicture picture;
    for (int i = 0; i < most_frames && !picture.steady; ++i) picture = next();
    EXPECT_TRUE(picture.steady);
    return picture;
  }

  SceneSnapshot world;  // of the next frame
  WorldCamera camera;
  Bounds grid_bounds;
  bool reset = true;             // the next frame knows nothing of the ones before
  bool samples_sources = false;  // somebody else brings the light straight from emitters and the environment

 private:
  template <class T>
  std::vector<T> fetch(const ReadbackTicket& ticket) {
    const std::vector<std::byte> bytes = executor_.fetch(frame_, ticket);
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  static std::vector<glm::vec4> to_floats(const std::vector<std::uint64_t>& halves) {
    std::vector<glm::vec4> values(halves.size());
    std::transform(halves.begin(), halves.end(), values.begin(),
                   [](std::uint64_t v) { return glm::unpackHalf4x16(v); });
    return values;
  }

  Scene scene_;
  std::uint32_t side_;
  GraphExecutor executor_;
  Submitter submitter_;
  GpuScene gpu_scene_;
  GpuEnvironment environment_;
  LightTable lights_;
  ShadowMaps shadow_maps_;
  std::unique_ptr<Technique> technique_;
  std::uint64_t frame_ = 0;
};

// Mean irradiance over the pixels with a surface, all channels.
inline double mean_irradiance(const SurfelPicture& picture) {
  double sum = 0.0;
  double pixels = 0.0;
  for (std::size_t i = 0; i < picture.irradiance.size(); ++i) {
    if (picture.position[i].w == 0.0f) continue;
    sum += (picture.irradiance[i].x + picture.irradiance[i].y + picture.irradiance[i].z) / 3.0;
    pixels += 1.0;
  }
  return pixels > 0.0 ? sum / pixels : 0.0;
}

}  // namespace lightwell
