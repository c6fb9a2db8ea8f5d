#include "passes/trace/tracer.h"

#include <optional>

#include "passes/trace/testing/trace_test_base.h"

namespace lightwell {
namespace {

using TracerTest = TraceTest;

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
  const ReadbackTicket ticket = graph.read_back(add_rays(graph, frame, traced, rays, false));
  run(graph);
  const auto found = fetch<glsl::ListedHit>(ticket);
  EXPECT_FLOAT_EQ(found[0].t, 0.5f);
  EXPECT_EQ(found[0].triangle, 0u);
  EXPECT_FLOAT_EQ(found[0].barycentrics.x, 0.25f);
  EXPECT_FLOAT_EQ(found[0].barycentrics.y, 0.5f);
  for (std::size_t i = 1; i < rays.size(); ++i) EXPECT_EQ(found[i].triangle, 0xffffffffu) << "ray " << i;
}

// Two equal triangles; the second may be moved up.
class RefusedFrames : public TraceTest, public ::testing::WithParamInterface<Tracing> {
 protected:
  void SetUp() override {
    TraceTest::SetUp();
    if (IsSkipped()) return;
    if (GetParam() == Tracing::kRayQuery && !device().has_ray_query())
      GTEST_SKIP() << device().summary().name << " has no ray queries";
    scene_ = one_triangle();
    scene_.nodes.push_back(scene_.nodes[0]);
    snapshot_ = take_snapshot(scene_);
    gpu_scene_.emplace(device(), scene_, snapshot_);
    tracer_.emplace(device(), GetParam());
  }

  void move_second_to(float z) { snapshot_.instances[1].to_world[3].z = z; }

  void refuse() {
    FrameGraph graph(executor().context());
    tracer_->record(graph, gpu_scene_->record(graph, snapshot_));
  }

  void show_without_tracing() {
    FrameGraph graph(executor().context());
    gpu_scene_->record(graph, snapshot_);
    run(graph);
  }

  // What a ray from z = 100 along -z meets first.
  float height() {
    FrameGraph graph(executor().context());
    const GpuScene::Frame frame = gpu_scene_->record(graph, snapshot_);
    const Tracer::Frame traced = tracer_->record(graph, frame);
    const std::vector<glsl::ListedRay> rays{{{0.2f, 0.2f, 100.0f}, 0.0f, {0, 0, -1}, 1000.0f}};
    const ReadbackTicket ticket = graph.read_back(add_rays(graph, frame, traced, rays, false));
    run(graph);
    return 100.0f - fetch<glsl::ListedHit>(ticket)[0].t;
  }

  Scene scene_;
  SceneSnapshot snapshot_;
  std::optional<GpuScene> gpu_scene_;
  std::optional<Tracer> tracer_;
};

TEST_P(RefusedFrames, AreNotBuilt) {
  show_without_tracing();
  refuse();
  EXPECT_FLOAT_EQ(height(), 0.0f);
}

TEST_P(RefusedFrames, AreNotFollowed) {
  move_second_to(1.0f);
  EXPECT_FLOAT_EQ(height(), 1.0f);
  for (const float z : {2.0f, 3.0f}) {  // joins the moving, then moves among them
    move_second_to(z);
    show_without_tracing();
    refuse();
    EXPECT_FLOAT_EQ(height(), z);
    move_second_to(50.0f);
    refuse();
    move_second_to(z);
    EXPECT_FLOAT_EQ(height(), z);
  }
}

INSTANTIATE_TEST_SUITE_P(Tracing, RefusedFrames, ::testing::Values(Tracing::kBvh, Tracing::kRayQuery),
                         [](const auto& info) { return info.param == Tracing::kBvh ? "Bvh" : "RayQuery"; });

}  // namespace
}  // namespace lightwell
