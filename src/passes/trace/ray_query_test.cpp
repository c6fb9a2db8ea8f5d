// Rays through the device's acceleration structures: what is built, updated and kept, and odd scenes and rays. That the
// answers are right in full scenes is for tests/trace_test.cpp.
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "passes/trace/testing/trace_test_base.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kNoTriangle = 0xffffffffu;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(RayQueryRanges, CoverEveryTriangleOnceAndNeverMixMasks) {
  constexpr unsigned kSeed = 3;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  for (int round = 0; round < 1000; ++round) {
    GpuScene::Frame scene;
    scene.triangle_count = random() % 20;
    scene.opaque_triangle_count = random() % (scene.triangle_count + 1);
    scene.moving_first = random() % (scene.triangle_count + 1);
    scene.moving_count = random() % (scene.triangle_count - scene.moving_first + 1);
    std::vector<int> seen(scene.triangle_count);
    for (const bool moves : {false, true}) {
      const std::vector<SceneRange> ranges = moves ? list_moving(scene) : list_standing(scene);
      EXPECT_LE(ranges.size(), 3u);
      for (const SceneRange& range : ranges) {
        EXPECT_GT(range.count, 0u);
        for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
          ASSERT_LT(i, scene.triangle_count);
          ++seen[i];
          EXPECT_EQ(range.opaque, i < scene.opaque_triangle_count);
          EXPECT_EQ(moves, i >= scene.moving_first && i - scene.moving_first < scene.moving_count);
        }
      }
    }
    for (const int times : seen) EXPECT_EQ(times, 1);
  }
}

// A scene of unit triangles (0,0,0) (1,0,0) (0,1,0), each an instance of its own.
class RayQueryTest : public TraceTest {
 protected:
  void SetUp() override {
    TraceTest::SetUp();
    if (!IsSkipped() && !device().has_ray_query()) GTEST_SKIP() << device().summary().name << " has no ray queries";
  }

  void add_triangle(const glm::vec3& at, int material = -1) {
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    primitive.normals.assign(3, {0, 0, 1});
    primitive.indices = {0, 1, 2};
    primitive.material = material;
    Node node;
    node.mesh = static_cast<int>(scene_.meshes.size());
    node.translation = at;
    scene_.meshes.push_back({"triangle", {primitive}, {}});
    scene_.nodes.push_back(node);
  }

  int add_mask(float alpha) {
    Material material;
    material.base_color.a = alpha;
    material.alpha_mode = AlphaMode::kMask;
    scene_.materials.push_back(material);
    return static_cast<int>(scene_.materials.size()) - 1;
  }

  void load() {
    snapshot_ = take_snapshot(scene_);
    gpu_scene_ = std::make_unique<GpuScene>(device(), scene_, snapshot_);
    tracer_ = std::make_unique<Tracer>(device(), Tracing::kRayQuery);
  }

  void move_to(std::size_t instance, const glm::vec3& at) {
    snapshot_.instances[instance].to_world[3] = glm::vec4(at, 1.0f);
  }

  // One frame. `edit` may say which triangles move.
  std::vector<glsl::ListedHit> trace(const std::vector<glsl::ListedRay>& rays, bool any_hit,
                                     const std::function<void(GpuScene::Frame&)>& edit = {}) {
    FrameGraph graph(executor().context());
    GpuScene::Frame frame = gpu_scene_->record(graph, snapshot_);
    if (edit) edit(frame);
    const Tracer::Frame traced = tracer_->record(graph, frame);
    const ReadbackTicket ticket = graph.read_back(add_rays(graph, frame, traced, rays, any_hit));
    run(graph);
    builds_ = updates_ = top_levels_ = 0;
    for (const Pass& pass : graph.passes()) {
      const std::string& name = base_of(pass).name;
      builds_ += name == "build acceleration structure";
      updates_ += name == "update acceleration structure";
      top_levels_ += name == "build top level";
    }
    return fetch<glsl::ListedHit>(ticket);
  }

  // The triangle that a ray along -z meets first, from z = 100 above (x, y).
  std::uint32_t triangle_below(float x, float y, const std::function<void(GpuScene::Frame&)>& edit = {}) {
    return trace({{{x, y, 100.0f}, 0.0f, {0, 0, -1}, 1e30f}}, false, edit)[0].triangle;
  }

  Scene scene_;
  SceneSnapshot snapshot_;
  std::unique_ptr<GpuScene> gpu_scene_;
  std::unique_ptr<Tracer> tracer_;
  int builds_ = 0, updates_ = 0, top_levels_ = 0;  // of the last frame
};

TEST_F(RayQueryTest, DirectionsHaveAnyLengthAndBothEndsCount) {
  add_triangle({0, 0, 0});
  load();
  const glm::vec3 origin{0.25f, 0.5f, 1.0f};
  const std::vector<glsl::ListedRay> rays{
      {origin, 0.0f, {0, 0, -2}, 10.0f}, {origin, 0.0f, {0, 0, -1e-3f}, 1e30f},     {origin, 1.0f, {0, 0, -1}, 2.0f},
      {origin, 0.0f, {0, 0, -1}, 1.0f},  {origin, 1.001f, {0, 0, -1}, 10.0f},       {origin, 0.0f, {0, 0, -1}, 0.999f},
      {origin, 0.0f, {0, 0, 1}, 1e30f},  {{0.75f, 0.5f, 1}, 0.0f, {0, 0, -1}, 9.0f}};
  const float expected[] = {0.5f, 1000.0f, 1.0f, 1.0f};
  const auto hits = trace(rays, false);
  const auto blocked = trace(rays, true);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(hits[i].triangle, i < 4 ? 0u : kNoTriangle) << "ray " << i;
    EXPECT_EQ(blocked[i].triangle, hits[i].triangle) << "ray " << i;
    if (i >= 4) continue;
    EXPECT_NEAR(hits[i].t, expected[i], 1e-6f * expected[i]) << "ray " << i;
    EXPECT_NEAR(hits[i].barycentrics.x, 0.25f, 1e-6f);
    EXPECT_NEAR(hits[i].barycentrics.y, 0.5f, 1e-6f);
  }
}

TEST_F(RayQueryTest, RaysThatAreNoneMeetNothing) {
  add_triangle({0, 0, 0});
  load();
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<glsl::ListedRay> rays{{{0.2f, 0.2f, 1}, 0.0f, {0, 0, 0}, 10.0f},
                                          {{0.2f, kNan, 1}, 0.0f, {0, 0, -1}, 10.0f},
                                          {{0.2f, 0.2f, 1}, 0.0f, {0, 0, -infinity}, 10.0f},
                                          {{0.2f, 0.2f, 1}, 2.0f, {0, 0, -1}, 1.0f},
                                          {{0.2f, 0.2f, 1}, 0.0f, {0, 0, -1}, kNan}};
  for (const bool any_hit : {false, true})
    for (const glsl::ListedHit& hit : trace(rays, any_hit)) EXPECT_EQ(hit.triangle, kNoTriangle);
}

TEST_F(RayQueryTest, MasksAreSeenThroughWhereTheyAreCut) {
  add_triangle({0, 0, 3}, add_mask(0.1f));
  add_triangle({0, 0, 2}, add_mask(0.9f));
  add_triangle({0, 0, 1});
  load();
  // Opaque triangles come first: 0 is at z = 1, 1 and 2 are the masks at z = 3 and 2.
  EXPECT_EQ(triangle_below(0.2f, 0.2f), 2u);
  const glsl::ListedRay past_the_cut_one{{0.2f, 0.2f, 3.5f}, 0.0f, {0, 0, -1}, 1.0f};
  EXPECT_EQ(trace({past_the_cut_one}, true)[0].triangle, kNoTriangle);
}

TEST_F(RayQueryTest, AnEmptySceneBlocksNothing) {
  load();
  EXPECT_EQ(triangle_below(0.2f, 0.2f), kNoTriangle);
  EXPECT_EQ(triangle_below(0.2f, 0.2f), kNoTriangle);
  EXPECT_EQ(top_levels_, 0) << "kept";
}

TEST_F(RayQueryTest, MovingTrianglesAreUpdatedAndStandingOnesKept) {
  add_triangle({0, 0, 0});
  add_triangle({2, 0, 0});
  add_triangle({4, 0, 0}, add_mask(0.9f));
  add_triangle({6, 0, 0}, add_mask(0.9f));
  load();
  EXPECT_EQ(triangle_below(0.2f, 0.2f), 0u);
  EXPECT_EQ(builds_, 1) << "all stand";
  EXPECT_EQ(triangle_below(2.2f, 0.2f), 1u);
  EXPECT_EQ(builds_ + updates_ + top_levels_, 0) << "nothing moved";
  int builds = 0;
  for (int step = 1; step <= 40; ++step) {
    const float x = 10.0f * static_cast<float>(step);
    move_to(1, {x, 0, 0});
    move_to(2, {x, 2, 0});
    std::vector<glsl::ListedRay> rays;
    for (const glm::vec2 at :
         {glm::vec2(0, 0), glm::vec2(x, 0), glm::vec2(x, 2), glm::vec2(6, 0), glm::vec2(x - 10, 2)})
      rays.push_back({{at.x + 0.2f, at.y + 0.2f, 1}, 0.0f, {0, 0, -1}, 2.0f});
    const auto hits = trace(rays, false);
    for (std::uint32_t i = 0; i < 4; ++i) ASSERT_EQ(hits[i].triangle, i) << "step " << step;
    EXPECT_EQ(hits[4].triangle, kNoTriangle) << "step " << step;
    EXPECT_EQ(builds_ + updates_, step == 1 ? 2 : 1) << "step " << step;
    EXPECT_EQ(top_levels_, 1);
    if (step > 1) builds += builds_;
  }
  EXPECT_EQ(builds, 1) << "of the moving ones, after 32 updates";
}

// Ever more of 24 triangles begin to move, a third of them with a mask that is cut out, a third with one that is not.
TEST_F(RayQueryTest, AgreesWithOurOwnHierarchyWhileThingsBeginToMove) {
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> coordinate(-2.0f, 2.0f);
  const auto point = [&] { return glm::vec3(coordinate(random), coordinate(random), coordinate(random)); };
  const int materials[] = {-1, add_mask(0.9f), add_mask(0.1f)};
  for (int i = 0; i < 24; ++i) add_triangle(point(), materials[i % 3]);
  load();
  Tracer own(device(), Tracing::kBvh);
  int met = 0;
  for (std::uint32_t frame = 0; frame < 12; ++frame) {
    for (std::uint32_t i = 0; i < frame; ++i) move_to(random() % (2 * frame), point());
    std::vector<glsl::ListedRay> rays(500);
    for (glsl::ListedRay& ray : rays) ray = {point(), 0.0f, point(), 4.0f};
    FrameGraph graph(executor().context());
    const GpuScene::Frame scene = gpu_scene_->record(graph, snapshot_);
    const Tracer::Frame ways[] = {own.record(graph, scene), tracer_->record(graph, scene)};
    ReadbackTicket tickets[4];
    for (std::size_t i = 0; i < 4; ++i) tickets[i] = graph.read_back(add_rays(graph, scene, ways[i % 2], rays, i >= 2));
    run(graph);
    const auto expected = fetch<glsl::ListedHit>(tickets[0]);
    const auto found = fetch<glsl::ListedHit>(tickets[1]);
    const auto expected_blocked = fetch<glsl::ListedHit>(tickets[2]);
    const auto blocked = fetch<glsl::ListedHit>(tickets[3]);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(found[i].triangle, expected[i].triangle) << "frame " << frame << " ray " << i;
      ASSERT_NEAR(found[i].t, expected[i].t, 1e-4f) << "frame " << frame << " ray " << i;
      ASSERT_EQ(blocked[i].triangle, expected_blocked[i].triangle) << "frame " << frame << " ray " << i;
      met += found[i].triangle != kNoTriangle;
    }
  }
  EXPECT_GT(met, 500);
}

TEST_F(RayQueryTest, WhatMovesMayChangeAndBeAll) {
  add_triangle({0, 0, 0});
  add_triangle({2, 0, 0});
  load();
  const auto moving = [](std::uint32_t first, std::uint32_t count) {
    return [=](GpuScene::Frame& frame) {
      frame.moving_first = first;
      frame.moving_count = count;
    };
  };
  const std::pair<std::uint32_t, std::uint32_t> parts[] = {{0, 0}, {1, 1}, {0, 2}, {0, 1}};
  for (const auto& [first, count] : parts) {
    EXPECT_EQ(triangle_below(0.2f, 0.2f, moving(first, count)), 0u) << first << " " << count;
    EXPECT_EQ(triangle_below(2.2f, 0.2f, moving(first, count)), 1u) << first << " " << count;
  }
}

TEST_F(RayQueryTest, TrianglesThatAreNotFiniteAreNeverMetAndHideNothing) {
  for (int i = 0; i < 9; ++i) add_triangle({2 * i, 0, 0});
  load();
  // Broken, whole again elsewhere, broken otherwise: built, then updated.
  const float strange[] = {kNan, 6.0f, std::numeric_limits<float>::infinity()};
  for (const float y : strange) {
    move_to(3, {6, y, 0});
    for (int i = 0; i < 9; ++i)
      EXPECT_EQ(triangle_below(2.0f * static_cast<float>(i) + 0.2f, 0.2f) == kNoTriangle, i == 3) << i << " " << y;
  }
}

TEST_F(RayQueryTest, MemoryIsAccountedAndGivenBack) {
  const auto bytes = [&] {
    std::uint64_t sum = 0;
    for (const auto& [name, use] : device().memory().report())
      if (name.starts_with("acceleration structure")) sum += use.bytes;
    return sum;
  };
  const std::uint64_t before = bytes();  // other tests' may still wait for their frame
  add_triangle({0, 0, 0});
  load();
  triangle_below(0.2f, 0.2f);
  EXPECT_GT(bytes(), before);
  tracer_.reset();
  for (int frame = 0; frame < 10; ++frame) {  // until the pool gives up what no frame used
    FrameGraph graph(executor().context());
    run(graph);
  }
  EXPECT_LE(bytes(), before);
}

}  // namespace
}  // namespace lightwell
