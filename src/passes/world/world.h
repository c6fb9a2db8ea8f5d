// The world on the device: the scene, its lights and environment, and services over them that are recorded at their
// first use in a frame, once for everybody.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <glm/ext/vector_float3.hpp>

#include "graph/frame_graph.h"
#include "lightwell/scene.h"
#include "passes/emitters/emitter_table.h"
#include "passes/environment/gpu_environment.h"
#include "passes/focus/focus_balls.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/lights/light_table.h"
#include "passes/shadow_maps/shadow_maps.h"
#include "passes/trace/tracer.h"

namespace lightwell {

class Device;

struct WorldOptions {
  std::uint32_t shadow_map_size = 1024;  // texels a side and view
  std::optional<Tracing> tracing;        // who answers rays; default: the faster here, measured at first use
  std::optional<Bounds> grid_bounds;     // what voxel grids and directional shadow maps cover; default: the scene
};

// What outlives a frame.
class World {
 public:
  // Throws InputError if the scene is too large for the device.
  World(Device& device, const Scene& scene, const SceneSnapshot& snapshot, const WorldOptions& options);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

 private:
  friend class WorldFrame;
  Tracer& find_tracer();

  Device& device_;
  WorldOptions options_;
  GpuScene scene_;
  GpuEnvironment environment_;
  LightTable lights_;
  ShadowMaps shadow_maps_;
  EmitterTable emitters_;
  std::optional<Tracer> tracer_;  // none before something has traced
  std::uint64_t frames_ = 0;      // declared so far
  // Of the last recorded frame.
  std::optional<double> last_time_;
  std::vector<FocusBall> last_focus_balls_;
};

// One frame of it. Lives while the graph is declared; keep the world until the frame was recorded or dropped.
class WorldFrame {
 public:
  // Declares what every frame needs: the scene as `snapshot` shows it, lights, environment. `time`: of the world's
  // clock, s. `cut`: what was gathered over the frames before is to be forgotten. `points_of_interest`: none is the
  // middle of the grid bounds.
  WorldFrame(FrameGraph& graph, World& world, const SceneSnapshot& snapshot, double time, bool cut = false,
             std::span<const glm::vec3> points_of_interest = {});
  WorldFrame(const WorldFrame&) = delete;
  WorldFrame& operator=(const WorldFrame&) = delete;

  const SceneSnapshot& snapshot;  // CPU side: instances, lights, bounds
  GpuScene::Frame scene;          // world-space vertices, indices, materials, textures; bind scene.set
  LightTable::Frame lights;
  ImageHandle environment;             // RGBA32F latitude-longitude, 1x1 if constant
  Bounds grid_bounds;                  // what voxel grids cover
  glm::vec3 focus{0.0f};               // m; about which grids and shadow maps are finest
  std::vector<FocusBall> focus_balls;  // of a large scene, finest first
  SceneRevisions revisions;
  std::uint64_t index = 0;  // rises by one with every frame that is declared
  double time = 0.0;        // s
  double time_step = 0.0;   // s since the last recorded frame; 0 in the first
  bool is_cut = false;      // the frames before say nothing about this one

  // Services.
  const Tracer::Frame& tracer();          // rays: trace_compute()
  const EmitterTable::Frame& emitters();  // emissive triangles by power
  BufferHandle environment_table();    // directions of the environment by brightness (shaders/environment_table.glsl)
  const ShadowMaps::Frame& shadows();  // read_lights() binds lights and shadows for shaders/direct.glsl
  // None where nobody has used shadows() so far.
  ImageHandle recorded_shadow_atlas() const { return shadows_ ? shadows_->atlas : ImageHandle{}; }

  const GpuEnvironment& gpu_environment() const { return world_.environment_; }
  std::uint32_t largest_image() const;  // texels a side that the device's 2D images have at most

 private:
  FrameGraph& graph_;
  World& world_;
  std::optional<Tracer::Frame> tracer_;
  std::optional<EmitterTable::Frame> emitters_;
  std::optional<BufferHandle> environment_table_;
  std::optional<ShadowMaps::Frame> shadows_;
};

// Declares a kernel that traces, after what it takes to answer its rays.
ComputePass& trace_compute(FrameGraph& graph, std::string_view name, const TraceKernel& kernel, WorldFrame& world);

}  // namespace lightwell
