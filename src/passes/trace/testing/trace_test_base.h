// Base of tests that trace lists of rays on the device.
#pragma once

#include <vector>

#include "graph/linear_dispatch.h"
#include "graph/testing/graph_test.h"
#include "kernels/passes/trace/trace_rays.comp.h"
#include "passes/trace/trace_rays_types.h"
#include "passes/trace/tracer.h"

namespace lightwell {

class TraceTest : public GraphTest {
 protected:
  // One scene with its hierarchy, from frame to frame.
  struct Traced {
    GpuScene gpu_scene;
    Tracer tracer;
    Traced(const Scene& scene, const SceneSnapshot& snapshot)
        : gpu_scene(device(), scene, snapshot), tracer(device(), Tracing::kBvh) {}
  };

  std::vector<glsl::ListedHit> trace(Traced& traced, const SceneSnapshot& snapshot,
                                     const std::vector<glsl::ListedRay>& rays, bool any_hit = false) {
    FrameGraph graph(executor().context());
    const GpuScene::Frame frame = traced.gpu_scene.record(graph, snapshot);
    const Tracer::Frame hierarchy = traced.tracer.record(graph, frame);
    const ReadbackTicket ticket = graph.read_back(add_rays(graph, frame, hierarchy, rays, any_hit));
    run(graph);
    return fetch<glsl::ListedHit>(ticket);
  }

  BufferHandle add_rays(FrameGraph& graph, const GpuScene::Frame& frame, const Tracer::Frame& hierarchy,
                        const std::vector<glsl::ListedRay>& rays, bool any_hit) {
    BufferHandle hits = graph.create_buffer("hits", rays.size(), sizeof(glsl::ListedHit));
    dispatch_linear(trace_compute(graph, "trace rays", kernels::trace_trace_rays_comp, frame, hierarchy)
                        .read("rays", graph.upload<glsl::ListedRay>("rays", rays))
                        .write("hits", hits)
                        .push(glsl::RayParams{static_cast<std::uint32_t>(rays.size()), any_hit ? 1u : 0u}),
                    rays.size());
    return hits;
  }
};

}  // namespace lightwell
