// Runs the surfel solver on a scene, frame by frame, the way the renderer does.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "gpu/submit.h"
#include "graph/executor.h"
#include "graph/testing/device_test.h"
#include "lightwell/scene.h"
#include "passes/camera/camera.h"
#include "passes/environment/gpu_environment.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/shadow_maps/shadow_maps.h"
#include "techniques/light_volume/surfel_passes.h"
#include "techniques/light_volume/surfel_solver.h"

namespace lightwell {

// RGBA of every pixel.
struct SurfelPicture {
  std::vector<glm::vec4> irradiance;
  std::vector<glm::vec4> position;  // w: 0 where there is no surface
  std::vector<glm::vec4> emission;
  bool steady = false;
};

class SurfelFrames {
 public:
  SurfelFrames(Device& device, Scene scene, const LightVolumeBestOptions& options, std::uint32_t side = 64)
      : world(take_snapshot(scene)),
        scene_(std::move(scene)),
        side_(side),
        executor_(device),
        submitter_(device),
        gpu_scene_(device, scene_, world),
        environment_(device, scene_.environment),
        technique_(options) {
    camera = world.cameras.empty() ? default_camera(world.bounds) : world.cameras[0];
    grid_bounds = world.bounds;
  }

  SurfelPicture next() {
    FrameGraph graph(executor_.context());
    const glsl::GpuCamera gpu_camera = make_gpu_camera(camera, {side_, side_}, glm::vec2(0.0f), nullptr);
    FrameInputs inputs;
    inputs.world = &world;
    inputs.grid_bounds = grid_bounds;
    inputs.camera = graph.upload("camera", std::span(&gpu_camera, 1));
    inputs.scene = gpu_scene_.record(graph, world);
    inputs.geometry_revision = inputs.scene.revision;
    inputs.environment = environment_.record(graph);
    const ShadowMaps::Frame shadows = shadow_maps_.record(graph, inputs.scene, world, grid_bounds, 512);
    inputs.lights = shadows.lights;
    inputs.light_count = shadows.light_count;
    inputs.shadow_atlas = shadows.atlas;
    inputs.gbuffer = record_gbuffer(graph, inputs.scene, inputs.camera, inputs.environment, side_, side_);
    const GiResult result = technique_.record(graph, inputs);
    const ReadbackTicket irradiance = graph.read_back(result.irradiance);
    const ReadbackTicket position = graph.read_back(inputs.gbuffer.position);
    const ReadbackTicket emission = graph.read_back(inputs.gbuffer.emission);
    submitter_.run([&](VkCommandBuffer commands) { frame_ = executor_.record(graph, commands, frame_); });
    return {fetch(irradiance), fetch(position), fetch(emission), result.steady};
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

 private:
  std::vector<glm::vec4> fetch(const ReadbackTicket& ticket) {
    const std::vector<std::byte> bytes = executor_.fetch(frame_, ticket);
    std::vector<glm::vec4> values(bytes.size() / sizeof(glm::vec4));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  Scene scene_;
  std::uint32_t side_;
  GraphExecutor executor_;
  Submitter submitter_;
  GpuScene gpu_scene_;
  GpuEnvironment environment_;
  ShadowMaps shadow_maps_;
  LightVolumeBest technique_;
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
