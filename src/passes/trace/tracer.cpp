#include "passes/trace/tracer.h"

#include <optional>

namespace lightwell {

struct Tracer::State {
  Tracing tracing = Tracing::kBvh;
  std::optional<BvhHierarchy> bvh;         // where kBvh
  std::optional<RayQueryScene> ray_query;  // where kRayQuery
};

Tracer::Tracer(Device& device, Tracing tracing) : state_(std::make_unique<State>()) {
  state_->tracing = tracing;
  if (tracing == Tracing::kBvh)
    state_->bvh.emplace();
  else
    state_->ray_query.emplace(device);
}

Tracer::~Tracer() = default;

Tracer::Frame Tracer::record(FrameGraph& graph, const GpuScene::Frame& scene) {
  Frame frame{state_->tracing, {}, {}, {}};
  if (frame.tracing == Tracing::kBvh) {
    frame.bvh = state_->bvh->record(graph, scene);
    frame.set = graph.create_set({.name = "hierarchy",
                                  .number = 2,
                                  .members = {{.binding = "bvh_nodes", .buffer = frame.bvh.nodes},
                                              {.binding = "bvh_triangles", .buffer = frame.bvh.triangles}}});
  } else {
    frame.ray_query = state_->ray_query->record(graph, scene);
    frame.set =
        graph.create_set({.name = "hierarchy",
                          .number = 2,
                          .members = {{.binding = "acceleration_structure", .structure = frame.ray_query.top_level},
                                      {.binding = "first_triangles", .buffer = frame.ray_query.first_triangles}}});
  }
  return frame;
}

ComputePass& trace_compute(FrameGraph& graph, std::string_view name, const TraceKernel& kernel,
                           const GpuScene::Frame& scene, const Tracer::Frame& tracer) {
  const bool bvh = tracer.tracing == Tracing::kBvh;
  return graph.compute(name, bvh ? kernel.bvh : kernel.ray_query).bind(scene.set).bind(tracer.set);
}

}  // namespace lightwell
