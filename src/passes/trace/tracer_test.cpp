#include "passes/trace/tracer.h"

#include "graph/linear_dispatch.h"
#include "graph/testing/graph_test.h"
#include "kernels/passes/trace/trace_rays.comp.h"
#include "passes/trace/trace_rays_types.h"

namespace lightwell {
namespace {

using TracerTest = GraphTest;

Scene one_triangle() {
  Scene scene;
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  primitive.normals.assign(3, {0, 0, 1});
  primitive.indices = {0, 1, 2};
  scene.meshes.push_back({"triangle", {primitive}, {}});
  Node node;
  node.mesh = 0;
  scene.nodes.push_back(node);
  return scene;
}

TEST_F(TracerTest, MeetsATriangleBetweenBothEndsOfTheRay) {
  const Scene scene = one_triangle();
  const SceneSnapshot snapshot = take_snapshot(scene);
  GpuScene gpu_scene(device(), scene, snapshot);
  Tracer tracer(device(), Tracing::kBvh);
  const std::vector<glsl::ListedRay> rays{{{0.25f, 0.5f, 1.0f}, 0.0f, {0, 0, -2}, 10.0f},
                                          {{0.25f, 0.5f, 1.0f}, 0.6f, {0, 0, -2}, 10.0f},
                                          {{0.25f, 0.5f, 1.0f}, 0.0f, {0, 0, -2}, 0.4f},
                                          {{0.75f, 0.5f, 1.0f}, 0.0f, {0, 0, -2}, 10.0f}};
  FrameGraph graph(executor().context());
  const GpuScene::Frame frame = gpu_scene.record(graph, snapshot);
  const Tracer::Frame traced = tracer.record(graph, frame);
  BufferHandle hits = graph.create_buffer("hits", rays.size(), sizeof(glsl::ListedHit));
  dispatch_linear(trace_compute(graph, "trace rays", kernels::trace_trace_rays_comp, frame, traced)
                      .read("rays", graph.upload<glsl::ListedRay>("rays", rays))
                      .write("hits", hits)
                      .push(glsl::RayParams{static_cast<std::uint32_t>(rays.size()), 0}),
                  rays.size());
  const ReadbackTicket ticket = graph.read_back(hits);
  run(graph);
  const auto found = fetch<glsl::ListedHit>(ticket);
  EXPECT_FLOAT_EQ(found[0].t, 0.5f);
  EXPECT_EQ(found[0].triangle, 0u);
  EXPECT_FLOAT_EQ(found[0].barycentrics.x, 0.25f);
  EXPECT_FLOAT_EQ(found[0].barycentrics.y, 0.5f);
  for (std::size_t i = 1; i < rays.size(); ++i) EXPECT_EQ(found[i].triangle, 0xffffffffu) << "ray " << i;
}

}  // namespace
}  // namespace lightwell
