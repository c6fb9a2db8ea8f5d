// Runs the world part of photon_splatting frame by frame and brings back what it made. For tests only.
#pragma once

#include <cstring>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gpu/submit.h"
#include "graph/executor.h"
#include "graph/plan.h"
#include "lightwell/scene.h"
#include "passes/light_paths/testing/light_path_frames.h"
#include "techniques/photon_splatting/splat_storage.h"
#include "techniques/photon_splatting/world_part.h"

namespace lightwell {

struct PhotonFrame {
  std::vector<glsl::Splat> splats;  // in use
  LightPoints points;               // of the last round, or of all where they are stratified
  std::vector<float> atlas;
  std::uint32_t atlas_width = 0;
  std::uint32_t map_side = 0;
  std::uint32_t maps_per_row = 0;
  std::vector<std::uint32_t> counts;
  std::uint64_t photon_bytes = 0;  // of all transient buffers, but those that splats and their maps are
  std::uint64_t splat_bytes = 0;
  std::map<std::string, double> times_ms;  // by pass

  float texel(std::uint32_t map, std::uint32_t x, std::uint32_t y) const {
    const std::uint32_t column = map % maps_per_row * map_side + x;
    const std::uint32_t row = map / maps_per_row * map_side + y;
    return atlas[std::size_t{row} * atlas_width + column];
  }
};

class PhotonFrames {
 public:
  PhotonFrames(Device& device, Scene scene, const PhotonOptions& options)
      : world(take_snapshot(scene)),
        scene_(std::move(scene)),
        executor_(device),
        submitter_(device),
        world_(device, scene_, world, {.tracing = Tracing::kBvh, .grid_bounds = world.bounds}),
        photons_(options) {}
  // With other lights than the scene's.
  PhotonFrames(Device& device, Scene scene, const std::vector<WorldLight>& lights, const PhotonOptions& options)
      : PhotonFrames(device, std::move(scene), options) {
    world.lights = lights;
  }

  PhotonFrame next() {
    FrameGraph graph(executor_.context());
    WorldFrame frame(graph, world_, world, 0.0);
    frame.tracer();
    frame.emitters();
    frame.environment_table();
    const std::size_t before = graph.buffers().size();
    photons_.record_world(graph, frame);
    const ReadbackTicket tickets[]{graph.read_back(photons_.splats()), graph.read_back(photons_.splat_counts()),
                                   graph.read_back(photons_.light_points()), graph.read_back(photons_.shadow_atlas())};
    PhotonFrame result{.atlas_width = graph.desc(photons_.shadow_atlas()).width,
                       .map_side = photons_.map_side(),
                       .maps_per_row = photons_.maps_per_row()};
    measure(graph, before, result);
    submitter_.run([&](VkCommandBuffer commands) { frame_ = executor_.record(graph, commands, frame_); });
    result.counts = fetch<std::uint32_t>(tickets[1]);
    const std::vector<glsl::StoredSplat> stored = fetch<glsl::StoredSplat>(tickets[0]);
    for (std::uint32_t i = 0; i < result.counts.at(0); ++i) result.splats.push_back(load_splat(stored.at(i), i));
    result.points = fetch<glsl::LightPoint>(tickets[2]);
    result.atlas = fetch<float>(tickets[3]);
    for (const PassTime& pass : executor_.pass_times(frame_)) result.times_ms[pass.name] += pass.time_ms;
    return result;
  }

  // Declares a frame that is dropped.
  void declare() {
    FrameGraph graph(executor_.context());
    WorldFrame frame(graph, world_, world, 0.0);
    photons_.record_world(graph, frame);
  }

  const PhotonWorld& photons() const { return photons_; }
  // As if descriptors reached no further.
  void limit_descriptor_range(std::uint64_t bytes) { executor_.context().descriptor_range = bytes; }

  SceneSnapshot world;  // of the next frame

 private:
  // Buffers declared from number `first` on, each piece of memory once.
  static void measure(const FrameGraph& graph, std::size_t first, PhotonFrame& result) {
    const Plan plan = make_plan(graph);
    std::set<std::uint32_t> slots;
    for (std::size_t i = first; i < graph.buffers().size(); ++i) {
      const std::uint32_t slot = plan.buffer_slots[i];
      if (slot == UINT32_MAX || !slots.insert(slot).second) continue;
      const std::string& name = graph.buffers()[i].name;
      const bool of_splats = name == "splats" || name == "photon starts";
      (of_splats ? result.splat_bytes : result.photon_bytes) += plan.buffer_pool[slot].size;
    }
  }

  template <class T>
  std::vector<T> fetch(const ReadbackTicket& ticket) {
    const std::vector<std::byte> bytes = executor_.fetch(frame_, ticket);
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
  }

  Scene scene_;
  GraphExecutor executor_;
  Submitter submitter_;
  World world_;
  PhotonWorld photons_;
  std::uint64_t frame_ = 0;
};

inline glm::dvec3 sum_flux(const std::vector<glsl::Splat>& splats) {
  glm::dvec3 sum(0.0);
  for (const glsl::Splat& splat : splats) sum += glm::dvec3(splat.flux);
  return sum;
}

}  // namespace lightwell
