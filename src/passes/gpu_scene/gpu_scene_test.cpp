// What the frames of a GpuScene say about what moves, and where they say it is.
#include "passes/gpu_scene/gpu_scene.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "graph/testing/graph_test.h"
#include "passes/gpu_scene/gpu_scene_types.h"

namespace lightwell {
namespace {

Primitive triangle(int material) {
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  primitive.normals.assign(3, {0, 0, 1});
  primitive.indices = {0, 1, 2};
  primitive.material = material;
  return primitive;
}

// Three nodes that each show an opaque triangle and one with holes, which emits; an animation turns the second.
Scene three_pairs() {
  Scene scene;
  scene.textures.push_back({"grey", 1, 1, {100, 100, 100, 255}});
  scene.materials.resize(2);
  scene.materials[0].base_color_texture.texture = 0;
  scene.materials[1].alpha_mode = AlphaMode::kMask;
  scene.materials[1].emission = glm::vec3(1.0f);
  scene.meshes.push_back({"pair", {triangle(1), triangle(0)}, {}});
  scene.nodes.resize(3);
  for (int i = 0; i < 3; ++i) {
    scene.nodes[static_cast<std::size_t>(i)].mesh = 0;
    scene.nodes[static_cast<std::size_t>(i)].translation = {10.0f * static_cast<float>(i), 0, 0};
  }
  AnimationChannel channel;
  channel.node = 1;
  channel.path = AnimationPath::kRotation;
  scene.animations.push_back({"turn", {channel}});
  return scene;
}

class GpuSceneTest : public GraphTest {
 protected:
  struct Result {
    GpuScene::Frame frame;
    std::vector<glsl::WorldVertex> vertices;
    std::vector<glm::vec4> previous;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> emissive;
    std::vector<std::byte> materials;
    std::vector<std::byte> texels;
    std::size_t passes = 0;

    // x of the first corners of triangles [first, first + count), in metres / 10, rounded: which node they belong to.
    std::multiset<int> nodes(std::uint32_t first, std::uint32_t count) const {
      std::multiset<int> found;
      for (std::uint32_t t = first; t < first + count; ++t)
        found.insert(static_cast<int>(vertices[indices[3 * t]].position_material.x / 10.0f + 0.5f));
      return found;
    }
  };

  Result show(GpuScene& gpu_scene, const SceneSnapshot& snapshot) {
    FrameGraph graph(executor().context());
    Result result;
    result.frame = gpu_scene.record(graph, snapshot);
    result.passes = graph.passes().size();
    const ReadbackTicket vertices = graph.read_back(result.frame.vertices);
    const ReadbackTicket previous = graph.read_back(result.frame.previous_positions);
    const ReadbackTicket indices = graph.read_back(result.frame.indices);
    const ReadbackTicket emissive = graph.read_back(result.frame.emissive_triangles);
    const ReadbackTicket materials = graph.read_back(result.frame.materials);
    const ReadbackTicket texels = graph.read_back(result.frame.textures[0]);
    run(graph);
    result.vertices = fetch<glsl::WorldVertex>(vertices);
    result.previous = fetch<glm::vec4>(previous);
    result.indices = fetch<std::uint32_t>(indices);
    result.emissive = fetch<std::uint32_t>(emissive);
    result.emissive.resize(result.frame.emissive_triangle_count);
    result.materials = fetch<std::byte>(materials);
    result.texels = fetch<std::byte>(texels);
    return result;
  }

  // A frame that is declared, and then does not come to be.
  void refuse(GpuScene& gpu_scene, const SceneSnapshot& snapshot) {
    FrameGraph graph(executor().context());
    gpu_scene.record(graph, snapshot);
  }
};

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

void move_by(MeshInstance& instance, const glm::vec3& offset) {
  instance.to_world = glm::translate(glm::mat4(1), offset) * instance.to_world;
}

// Largest distance between where vertices are and where they were a frame ago, in metres.
float largest_motion(const std::vector<glsl::WorldVertex>& vertices, const std::vector<glm::vec4>& previous) {
  float largest = 0.0f;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    largest = std::max(largest, glm::distance(glm::vec3(vertices[i].position_material), glm::vec3(previous[i])));
  return largest;
}

TEST_F(GpuSceneTest, AnimatedTrianglesAreOneRange) {
  const Scene scene = three_pairs();
  const SceneSnapshot snapshot = take_snapshot(scene);
  GpuScene gpu_scene(device(), scene, snapshot);
  const Result shown = show(gpu_scene, snapshot);
  EXPECT_EQ(shown.frame.opaque_triangle_count, 3u);
  EXPECT_EQ(shown.frame.moving_first, 2u);
  EXPECT_EQ(shown.frame.moving_count, 2u);
  EXPECT_EQ(shown.nodes(0, 2), (std::multiset<int>{0, 2}));
  EXPECT_EQ(shown.nodes(2, 2), (std::multiset<int>{1, 1}));
  EXPECT_EQ(shown.nodes(4, 2), (std::multiset<int>{0, 2}));
  for (std::uint32_t t = 0; t < 6; ++t) {
    const std::uint32_t material =
        std::bit_cast<std::uint32_t>(shown.vertices[shown.indices[3 * t]].position_material.w);
    EXPECT_EQ(material, t < 3 ? 0u : 1u) << "triangle " << t;
  }
}

TEST_F(GpuSceneTest, WhatIsAnimatedMovesWithoutANewOrder) {
  const Scene scene = three_pairs();
  SceneSnapshot snapshot = take_snapshot(scene);
  GpuScene gpu_scene(device(), scene, snapshot);
  const Result first = show(gpu_scene, snapshot);
  move_by(snapshot.instances[1], {0, 2, 0});
  const Result second = show(gpu_scene, snapshot);
  EXPECT_NE(second.frame.revisions.moving_geometry, first.frame.revisions.moving_geometry);
  EXPECT_EQ(second.frame.revisions.static_geometry, first.frame.revisions.static_geometry);
  EXPECT_EQ(second.indices, first.indices);
  EXPECT_EQ(largest_motion(second.vertices, second.previous), 2.0f);
  EXPECT_EQ(largest_motion(first.vertices, second.previous), 0.0f);
}

TEST_F(GpuSceneTest, WhatAHostMovesJoinsTheMoving) {
  const Scene scene = three_pairs();
  SceneSnapshot snapshot = take_snapshot(scene);
  GpuScene gpu_scene(device(), scene, snapshot);
  const Result first = show(gpu_scene, snapshot);
  move_by(snapshot.instances[2], {0, 0, 3});
  const Result second = show(gpu_scene, snapshot);
  EXPECT_NE(second.frame.revisions.moving_geometry, first.frame.revisions.moving_geometry);
  EXPECT_NE(second.frame.revisions.static_geometry, first.frame.revisions.static_geometry);
  EXPECT_EQ(second.frame.opaque_triangle_count, 3u);
  EXPECT_EQ(second.frame.moving_first, 1u);
  EXPECT_EQ(second.frame.moving_count, 4u);
  EXPECT_EQ(second.nodes(1, 4), (std::multiset<int>{1, 1, 2, 2}));
  EXPECT_EQ(largest_motion(first.vertices, second.previous), 0.0f);
  EXPECT_EQ(largest_motion(second.vertices, second.previous), 3.0f);

  // From then on it is one of them.
  move_by(snapshot.instances[2], {0, 0, 1});
  const Result third = show(gpu_scene, snapshot);
  EXPECT_NE(third.frame.revisions.moving_geometry, second.frame.revisions.moving_geometry);
  EXPECT_EQ(third.frame.revisions.static_geometry, second.frame.revisions.static_geometry);
  EXPECT_EQ(third.indices, second.indices);
  EXPECT_EQ(largest_motion(third.vertices, third.previous), 1.0f);
}

TEST_F(GpuSceneTest, AFrameWithoutMovementCostsNothing) {
  const Scene scene = three_pairs();
  SceneSnapshot snapshot = take_snapshot(scene);
  GpuScene gpu_scene(device(), scene, snapshot);
  const Result first = show(gpu_scene, snapshot);
  EXPECT_GT(first.passes, 0u);
  EXPECT_EQ(largest_motion(first.vertices, first.previous), 0.0f);
  EXPECT_EQ(show(gpu_scene, snapshot).passes, 0u);
  move_by(snapshot.instances[0], {1, 0, 0});
  const Result moved = show(gpu_scene, snapshot);

  // The frame after a movement brings the previous positions up to date, no more.
  const Result stopped = show(gpu_scene, snapshot);
  EXPECT_EQ(stopped.frame.revisions.moving_geometry, moved.frame.revisions.moving_geometry);
  EXPECT_EQ(stopped.frame.revisions.static_geometry, moved.frame.revisions.static_geometry);
  EXPECT_EQ(largest_motion(moved.vertices, moved.previous), 1.0f);
  EXPECT_EQ(largest_motion(stopped.vertices, stopped.previous), 0.0f);
  EXPECT_EQ(largest_motion(moved.vertices, stopped.previous), 0.0f);
  const Result still = show(gpu_scene, snapshot);
  EXPECT_EQ(still.passes, 0u);
  EXPECT_EQ(still.previous, stopped.previous);
  EXPECT_EQ(still.frame.revisions.moving_geometry, moved.frame.revisions.moving_geometry);
}

// Movement in frames that are refused does not count.
TEST_F(GpuSceneTest, WhatCameToRestIsStaticAgain) {
  const Scene scene = three_pairs();
  SceneSnapshot snapshot = take_snapshot(scene);
  GpuScene gpu_scene(device(), scene, snapshot);
  const Result first = show(gpu_scene, snapshot);
  move_by(snapshot.instances[2], {0, 0, 3});
  const Result moved = show(gpu_scene, snapshot);
  EXPECT_EQ(moved.frame.moving_count, 4u);
  SceneSnapshot elsewhere = snapshot;
  move_by(elsewhere.instances[2], {0, 0, 1});
  Result last = moved;
  int orders = 0;
  for (int still = 1; still <= 40; ++still) {
    refuse(gpu_scene, elsewhere);
    const Result now = show(gpu_scene, snapshot);
    EXPECT_EQ(now.frame.moving_count, still <= 30 ? 4u : 2u) << "still for " << still << " frames";
    EXPECT_FALSE(surfaces_changed(now.frame.revisions, moved.frame.revisions));
    EXPECT_EQ(geometry_changed(now.frame.revisions, last.frame.revisions), still == 31);
    orders += now.frame.revisions.static_geometry != last.frame.revisions.static_geometry ? 1 : 0;
    EXPECT_TRUE(same_bytes(now.vertices, moved.vertices));
    last = now;
  }
  EXPECT_EQ(orders, 1);
  EXPECT_EQ(last.indices, first.indices);
  EXPECT_EQ(last.emissive, first.emissive);
}

// Frames of which some are refused show what they would without those. Each step: how far two instances are from where
// they were in the beginning, and whether the frame is refused.
TEST_F(GpuSceneTest, RefusedFramesLeaveNoTrace) {
  struct Step {
    float second;  // animated
    float third;   // moved by the host
    bool refused;
  };
  const std::vector<Step> steps{{0, 5, true},  {0, 0, false}, {2, 3, true},  {0, 0, false},
                                {0, 3, true},  {0, 3, false}, {1, 4, true},  {1, 3, false},
                                {1, 3, false}, {1, 4, true},  {3, 7, false}, {3, 7, false}};
  const Scene scene = three_pairs();
  const SceneSnapshot start = take_snapshot(scene);
  GpuScene with_refused(device(), scene, start);
  GpuScene without(device(), scene, start);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    SCOPED_TRACE("step " + std::to_string(i));
    SceneSnapshot snapshot = start;
    move_by(snapshot.instances[1], {0, steps[i].second, 0});
    move_by(snapshot.instances[2], {0, 0, steps[i].third});
    if (steps[i].refused) {
      refuse(with_refused, snapshot);
      continue;
    }
    const Result found = show(with_refused, snapshot);
    const Result expected = show(without, snapshot);
    EXPECT_EQ(found.passes, expected.passes);
    EXPECT_TRUE(same_bytes(found.vertices, expected.vertices));
    EXPECT_TRUE(same_bytes(found.previous, expected.previous));
    EXPECT_EQ(found.indices, expected.indices);
    EXPECT_EQ(found.emissive, expected.emissive);
    EXPECT_EQ(found.materials, expected.materials);
    EXPECT_EQ(found.texels, expected.texels);
    EXPECT_EQ(found.frame.moving_count, expected.frame.moving_count);
  }
}

// A number that a refused frame had is not given to another content.
TEST_F(GpuSceneTest, RevisionsOfRefusedFramesAreNotUsedAgain) {
  const Scene scene = three_pairs();
  SceneSnapshot snapshot = take_snapshot(scene);
  GpuScene gpu_scene(device(), scene, snapshot);
  const SceneRevisions shown = show(gpu_scene, snapshot).frame.revisions;
  EXPECT_EQ(show(gpu_scene, snapshot).frame.revisions, shown);
  move_by(snapshot.instances[2], {0, 0, 3});
  FrameGraph graph(executor().context());
  const SceneRevisions refused = gpu_scene.record(graph, snapshot).revisions;
  EXPECT_TRUE(geometry_changed(shown, refused));
  move_by(snapshot.instances[2], {0, 0, 1});
  const SceneRevisions next = show(gpu_scene, snapshot).frame.revisions;
  EXPECT_NE(next.static_geometry, refused.static_geometry);
  EXPECT_NE(next.moving_geometry, refused.moving_geometry);
}

TEST_F(GpuSceneTest, StagedBytesAreGivenBackOnceTheyAreCopied) {
  const Scene scene = three_pairs();
  const SceneSnapshot snapshot = take_snapshot(scene);
  GpuScene gpu_scene(device(), scene, snapshot);
  const auto staged = [&] { return device().memory().report()["textures 128 upload"].bytes; };
  const std::uint64_t all = staged();
  EXPECT_GE(all, 128u * 128 * 4);
  refuse(gpu_scene, snapshot);
  EXPECT_EQ(staged(), all);
  for (int i = 0; i < 4; ++i) show(gpu_scene, snapshot);
  EXPECT_LE(staged(), all - 128u * 128 * 4);
}

TEST_F(GpuSceneTest, MemoryIsThatOfTheFirstFrame) {
  const Scene scene = three_pairs();
  SceneSnapshot snapshot = take_snapshot(scene);
  GpuScene gpu_scene(device(), scene, snapshot);
  const auto bytes_of = [&](const char* name) { return device().memory().report()[name].bytes; };
  show(gpu_scene, snapshot);
  const std::array<std::uint64_t, 3> before{bytes_of("world vertices"), bytes_of("previous positions"),
                                            bytes_of("indices")};
  EXPECT_GE(before[0], 18 * sizeof(glsl::WorldVertex));
  for (int i = 0; i < 3; ++i) {
    move_by(snapshot.instances[2], {0, 1, 0});
    show(gpu_scene, snapshot);
  }
  EXPECT_EQ(before, (std::array<std::uint64_t, 3>{bytes_of("world vertices"), bytes_of("previous positions"),
                                                  bytes_of("indices")}));
}

// The last of as many materials as there may be, and the default one behind them.
TEST_F(GpuSceneTest, VerticesKnowTheLargestMaterials) {
  Scene scene;
  scene.materials.resize(glsl::kMaxMaterials);
  scene.meshes.push_back({"pair", {triangle(65534), triangle(-1)}, {}});
  scene.nodes.resize(1);
  scene.nodes[0].mesh = 0;
  const SceneSnapshot snapshot = take_snapshot(scene);
  GpuScene gpu_scene(device(), scene, snapshot);
  const Result shown = show(gpu_scene, snapshot);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(shown.vertices[0].position_material.w), 65534u);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(shown.vertices[3].position_material.w), 65535u);
}

TEST_F(GpuSceneTest, AnEmptySceneHasFramesToo) {
  GpuScene gpu_scene(device(), Scene(), SceneSnapshot());
  FrameGraph graph(executor().context());
  const GpuScene::Frame frame = gpu_scene.record(graph, SceneSnapshot());
  run(graph);
  EXPECT_EQ(frame.triangle_count, 0u);
  EXPECT_EQ(frame.moving_count, 0u);
}

}  // namespace
}  // namespace lightwell
