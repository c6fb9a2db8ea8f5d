// Direct light of emissive triangles and of the environment, by traced samples: soft shadows that converge over frames.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "graph/frame_graph.h"
#include "passes/environment/gpu_environment.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/reprojection/reprojection.h"
#include "passes/trace/tracer.h"
#include "shaders/camera.h"

namespace lightwell {

// Every frame takes `samples` points on emitters, as many directions of the environment's map and as many
// cosine-distributed rays at each visible surface. The mean over frames is the truth: nothing is clamped. What a few
// frames leave of noise is filtered, less and less as it falls.
class SampledLights {
 public:
  struct Settings {
    std::uint32_t samples = 1;  // of each kind, a pixel and frame; time in proportion
    bool filter = true;         // false: the mean as it is
    bool emitters = true;       // false: the environment alone
  };

  struct Frame {
    ImageHandle irradiance;  // RGBA32F, W/m^2 before albedo: what the frame adds to direct; empty: no such light
    ImageHandle mean;        // the same without the filter; w: frames in it
    ImageHandle sampled;     // of this frame alone
    bool steady = true;      // enough samples: another frame would hardly change it
  };

  SampledLights();
  ~SampledLights();

  // Whether there is such light at all; otherwise record() need not be called.
  static bool has_light(std::uint32_t emissive_triangle_count, const GpuEnvironment& environment,
                        const Settings& settings);

  // Declares this frame's passes. `environment_map`: what `environment` recorded this frame. `camera`: this frame's.
  // `reset`: the frames before say nothing about this one. `frame_index` rises by one a frame. Throws InputError if the
  // device cannot hold the list of emitters.
  Frame record(FrameGraph& graph, const GBuffer& gbuffer, const GpuScene::Frame& scene, const Tracer::Frame& tracer,
               const Reprojection& reprojection, GpuEnvironment& environment, ImageHandle environment_map,
               const glsl::GpuCamera& camera, const Settings& settings, bool reset, std::uint64_t frame_index);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lightwell
