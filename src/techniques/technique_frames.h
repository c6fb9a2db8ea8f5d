// Runs a technique on a scene, frame by frame, the way the renderer does. For tests only.
#pragma once

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "gpu/submit.h"
#include "graph/executor.h"
#include "graph/testing/device_test.h"
#include "lightwell/scene.h"
#include "passes/direct/direct.h"
#include "passes/view/view_frame.h"
#include "shaders/surface_point.h"
#include "techniques/technique.h"

namespace lightwell {

// RGBA of every pixel.
struct TechniquePicture {
  std::vector<glm::vec4> irradiance;  // of the technique
  std::vector<glm::vec4> direct;      // irradiance of the lights
  std::vector<glm::vec4> position;    // w: 0 where there is no surface
  std::vector<glm::vec4> normal;
  std::vector<glm::vec4> albedo;
  std::map<std::string, double> times_ms;  // by pass
  bool steady = false;
};

class TechniqueFrames {
 public:
  TechniqueFrames(Device& device, Scene scene, std::unique_ptr<Technique> technique, std::uint32_t side = 64)
      : world(take_snapshot(scene)),
        scene_(std::move(scene)),
        side_(side),
        executor_(device),
        submitter_(device),
        device_(device),
        technique_(std::move(technique)) {
    camera = world.cameras.empty() ? default_camera(world.bounds) : world.cameras[0];
    grid_bounds = world.bounds;
  }

  TechniquePicture next() {
    if (std::exchange(restart, false) || !technique_world_) {
      last_camera_.reset();
      const LightKinds direct = samples_sources ? LightKinds::kAll - LightKinds::kBounced : LightKinds::kLights;
      technique_world_ = technique_->create_world(technique_->covers(direct));
    }
    if (!world_)
      world_.emplace(device_, scene_, world, WorldOptions{.shadow_map_size = 512, .grid_bounds = grid_bounds});
    FrameGraph graph(executor_.context());
    const FrameGraph::Scope scope = graph.enter("", !last_camera_);
    WorldFrame world_frame(graph, *world_, world, 0.0, !last_camera_, points_of_interest);
    ViewFrame view(graph, world_frame, {side_, side_}, camera, PixelSample{}, last_camera_ ? &*last_camera_ : nullptr);
    last_camera_ = view.camera;
    const ImageHandle direct = record_direct(graph, view);
    technique_world_->record_world(graph, world_frame);
    const GiResult result = technique_->record_view(graph, technique_world_.get(), view);
    const GBuffer& gbuffer = view.gbuffer;
    std::vector<ReadbackTicket> tickets;
    for (const ImageHandle image : {result.irradiance, direct, gbuffer.position})
      tickets.push_back(graph.read_back(image));
    for (const ImageHandle image : {gbuffer.normal, gbuffer.albedo}) tickets.push_back(graph.read_back(image));
    submitter_.run([&](VkCommandBuffer commands) { frame_ = executor_.record(graph, commands, frame_); });

    TechniquePicture picture{.irradiance = fetch<glm::vec4>(tickets[0]),
                             .direct = fetch<glm::vec4>(tickets[1]),
                             .position = fetch<glm::vec4>(tickets[2]),
                             .normal = to_floats(fetch<std::uint64_t>(tickets[3])),
                             .albedo = to_floats(fetch<std::uint64_t>(tickets[4])),
                             .times_ms = {},
                             .steady = result.steady};
    for (const PassTime& pass : executor_.pass_times(frame_)) picture.times_ms[pass.name] += pass.time_ms;
    return picture;
  }

  TechniquePicture run_until_steady(int most_frames = 200) {
    TechniquePicture picture;
    for (int i = 0; i < most_frames && !picture.steady; ++i) picture = next();
    EXPECT_TRUE(picture.steady);
    return picture;
  }

  // The technique's answer in the next frame at the places of a picture's pixels.
  std::vector<glm::vec4> irradiance_at(const TechniquePicture& picture) {
    std::vector<glsl::SurfacePoint> points;
    for (std::size_t i = 0; i < picture.position.size(); ++i)
      points.push_back({picture.position[i], picture.normal[i]});
    FrameGraph graph(executor_.context());
    const FrameGraph::Scope scope = graph.enter("", false);
    WorldFrame world_frame(graph, *world_, world, 0.0, false, points_of_interest);
    technique_world_->record_world(graph, world_frame);
    const Points list{graph.upload<glsl::SurfacePoint>("points", points), static_cast<std::uint32_t>(points.size())};
    const ReadbackTicket ticket = graph.read_back(technique_world_->record_points(graph, world_frame, list));
    submitter_.run([&](VkCommandBuffer commands) { frame_ = executor_.record(graph, commands, frame_); });
    return fetch<glm::vec4>(ticket);
  }

  SceneSnapshot world;  // of the next frame
  WorldCamera camera;
  Bounds grid_bounds;  // of all frames
  std::vector<glm::vec3> points_of_interest;
  bool restart = false;          // the next frame knows nothing of the ones before
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
  Device& device_;
  std::optional<World> world_;
  std::unique_ptr<Technique> technique_;
  std::unique_ptr<TechniqueWorld> technique_world_;
  std::optional<glsl::GpuCamera> last_camera_;
  std::uint64_t frame_ = 0;
};

// Mean irradiance over the pixels with a surface, all channels.
inline double mean_irradiance(const TechniquePicture& picture) {
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
