// Ray tracing against the scene as it is this frame: host side of shaders/trace.glsl.
#pragma once

#include <memory>
#include <string_view>

#include "graph/frame_graph.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/trace/bvh_hierarchy.h"
#include "passes/trace/ray_query_scene.h"

namespace lightwell {

class Device;

// Who answers rays: our own bounding volume hierarchy, or the device's acceleration structures.
enum class Tracing : std::uint8_t { kBvh, kRayQuery };

class Tracer {
 public:
  struct Frame {
    Tracing tracing = Tracing::kBvh;
    BvhHierarchy::Frame bvh;         // where kBvh
    RayQueryScene::Frame ray_query;  // where kRayQuery
    SetHandle set;                   // set 2 of kernels that trace: what answers their rays
  };

  // Tracing::kRayQuery: the device has ray queries.
  Tracer(Device& device, Tracing tracing);
  ~Tracer();

  // Declares the passes that bring the hierarchy up to this frame's vertices: built where triangles are new, refitted
  // or built again where they moved, kept where they stand still.
  Frame record(FrameGraph& graph, const GpuScene::Frame& scene);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Declares a kernel that traces, with everything bound that shaders/trace.glsl declares.
ComputePass& trace_compute(FrameGraph& graph, std::string_view name, const TraceKernel& kernel,
                           const GpuScene::Frame& scene, const Tracer::Frame& tracer);

}  // namespace lightwell
