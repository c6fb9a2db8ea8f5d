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
    state_->bvh.emplace(device);
  else
    state_->ray_query.emplace(device);
}

Tracer::~Tracer() = default;

Tracer::Frame Tracer::record(FrameGraph& graph, const GpuScene::Frame& scene) {
  Frame frame{state_->tracing, {}, {}};
  if (frame.tracing == Tracing::kBvh)
    frame.bvh = state_->bvh->record(graph, scene);
  else
    frame.ray_query = state_->ray_query->record(graph, scene);
  return frame;
}

Pass& trace_compute(FrameGraph& graph, std::string_view name, const TraceKernel& kernel, const GpuScene::Frame& scene,
                    const Tracer::Frame& tracer) {
  const bool bvh = tracer.tracing == Tracing::kBvh;
  Pass& pass = graph.compute(name, bvh ? kernel.bvh : kernel.ray_query);
  if (bvh)
    pass.read("bvh_nodes", tracer.bvh.nodes).read("bvh_triangles", tracer.bvh.triangles);
  else
    pass.read("acceleration_structure", tracer.ray_query.top_level)
        .read("first_triangles", tracer.ray_query.first_triangles);
  return read_materials(pass, scene)
      .read("vertices", scene.vertices)
      .read("indices", scene.indices)
      .constant("kOpaqueTriangles",
                scene.opaque_triangle_count < scene.triangle_count ? scene.opaque_triangle_count : 0xffffffffu);
}

}  // namespace lightwell
