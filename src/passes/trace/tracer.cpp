#include "passes/trace/tracer.h"

namespace lightwell {

struct Tracer::State {
  Tracing tracing = Tracing::kBvh;
};

Tracer::Tracer(Device&, Tracing tracing) : state_(std::make_unique<State>()) {
  state_->tracing = tracing;
}

Tracer::~Tracer() = default;

Tracer::Frame Tracer::record(FrameGraph&, const GpuScene::Frame&) {
  return {state_->tracing};
}

Pass& trace_compute(FrameGraph& graph, std::string_view name, const TraceKernel& kernel, const GpuScene::Frame& scene,
                    const Tracer::Frame& tracer) {
  return graph.compute(name, tracer.tracing == Tracing::kBvh ? kernel.bvh : kernel.ray_query)
      .read("vertices", scene.vertices)
      .read("indices", scene.indices)
      .read("materials", scene.materials)
      .read("textures_0", scene.textures[0], SamplerKind::kLinearRepeat)
      .read("textures_1", scene.textures[1], SamplerKind::kLinearRepeat)
      .read("textures_2", scene.textures[2], SamplerKind::kLinearRepeat)
      .read("textures_3", scene.textures[3], SamplerKind::kLinearRepeat)
      .constant("kTextureArrays", scene.texture_arrays)
      .constant("kOpaqueTriangles", scene.opaque_triangle_count);
}

}  // namespace lightwell
