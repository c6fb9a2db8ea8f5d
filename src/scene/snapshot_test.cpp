#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "scene/pose.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

TEST(Snapshot, OfAnEmptySceneHasEmptyBounds) {
  const SceneSnapshot snapshot = take_snapshot(Scene());
  EXPECT_TRUE(snapshot.instances.empty());
  EXPECT_EQ(snapshot.bounds.minimum, snapshot.bounds.maximum);
}

// A snapshot holds the whole pose: moving the scene's nodes afterwards changes nothing, and giving moved nodes does.
TEST(Snapshot, CarriesThePose) {
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  Primitive& p = mesh.primitives.emplace_back();
  p.positions = {{0, 0, 0}};
  p.normals = {{0, 0, 1}};
  p.morph_targets = {{{{0, 1, 0}}, {}}};
  mesh.morph_weights = {2.0f};
  p.joints = {glm::u16vec4(0, 1, 0, 0)};
  p.weights = {glm::vec4(0.75f, 0.25f, 0, 0)};
  scene.nodes.resize(3);
  for (int i = 1; i < 3; ++i) scene.nodes[static_cast<std::size_t>(i)].parent = 0;
  scene.nodes[0].translation = {8, 0, 0};
  scene.nodes[1].mesh = 0;
  scene.nodes[1].skin = 0;
  scene.nodes[1].translation = {0, 0, 100};  // of no effect on what is skinned
  scene.nodes[2].translation = {0, 0, 4};
  scene.skins = {{{0, 2}, {glm::mat4(1), glm::translate(glm::mat4(1), glm::vec3(-8, 0, 0))}}};
  validate(scene, "test");

  const MeshInstance rest = take_snapshot(scene).instances.at(0);
  EXPECT_EQ(rest.joints.size(), 2u);
  EXPECT_EQ(rest.morph_weights, std::vector<float>{2.0f});
  EXPECT_VEC3_NEAR(glm::vec3(rest.to_world[3]), glm::vec3(8, 0, 100), 0.0f);
  // 3/4 of (8, 2, 0) and 1/4 of (0, 2, 4)
  EXPECT_VEC3_NEAR(pose_primitive(p, rest).positions[0], glm::vec3(6, 2, 1), 1e-6f);

  std::vector<Node> nodes = scene.nodes;
  nodes[2].translation.z = 8;
  nodes[1].morph_weights = {-1.0f};
  const SceneSnapshot moved = take_snapshot(scene, nodes);
  EXPECT_VEC3_NEAR(pose_primitive(p, moved.instances.at(0)).positions[0], glm::vec3(6, -1, 2), 1e-6f);
  EXPECT_VEC3_NEAR(moved.bounds.minimum, glm::vec3(6, -1, 2), 1e-6f);
  EXPECT_VEC3_NEAR(take_snapshot(scene).bounds.minimum, glm::vec3(6, 2, 1), 1e-6f);

  // Without joints of its own the primitive goes with the node.
  p.joints.clear();
  p.weights.clear();
  EXPECT_VEC3_NEAR(pose_primitive(p, rest).positions[0], glm::vec3(8, 2, 100), 1e-6f);
}

// What nodes can be moved to is refused where it cannot be shown.
TEST(Snapshot, OfPlacesTooFarIsRefused) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  Scene scene;
  Primitive& p = scene.meshes.emplace_back().primitives.emplace_back();
  p.positions = {{0, 0, 0}, {1, 0, 0}};
  p.normals.assign(2, {0, 0, 1});
  p.morph_targets = {{{{0, 0, 0}, {0, 2, 0}}, {}}, {{{0, 0, 0}, {0, -2, 0}}, {}}};
  scene.meshes[0].morph_weights = {0.0f, 0.0f};
  scene.lights.emplace_back();
  scene.cameras.emplace_back();
  scene.nodes.resize(3);
  scene.nodes[0].mesh = 0;
  scene.nodes[1].light = 0;
  scene.nodes[2].camera = 0;
  validate(scene, "test");
  EXPECT_NO_THROW(validate(take_snapshot(scene), "test"));
  for (std::size_t node = 0; node < 3; ++node)
    for (const float x : {2e9f, -3e38f, HUGE_VALF, kNan}) {
      std::vector<Node> nodes = scene.nodes;
      nodes[node].translation.x = x;
      EXPECT_THROW(validate(take_snapshot(scene, nodes), "test"), InputError) << node << " at " << x;
    }
  // The last pair takes a vertex to infinity from both sides: its place is no number.
  for (const std::vector<float>& weights :
       {std::vector{2e9f, 0.0f}, std::vector{0.0f, HUGE_VALF}, std::vector{kNan, 0.0f}, std::vector{3e38f, 3e38f}}) {
    std::vector<Node> nodes = scene.nodes;
    nodes[0].morph_weights = weights;
    EXPECT_THROW(validate(take_snapshot(scene, nodes), "test"), InputError) << weights[0] << " " << weights[1];
  }
}

// Normals stay perpendicular to their triangles, and on the same side, under stretching, shearing and mirroring.
TEST(Pose, NormalsFollowTheirTriangles) {
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 1}, {0, 1, 1}};
  p.normals.assign(3, glm::normalize(glm::vec3(-1, -1, 1)));
  p.indices = {0, 1, 2};
  const glm::mat4 stretch(3, 0, 0, 0, 0.5f, 1, 0, 0, 0, 0, 0.2f, 0, 5, 6, 7, 1);
  const glm::mat4 mirror(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  for (const glm::mat4& m : {stretch, mirror, mirror * stretch, glm::scale(stretch, glm::vec3(1e-4f))}) {
    const PosedVertices posed = pose_primitive(p, {.mesh = 0, .to_world = m});
    const float mirrored = glm::determinant(glm::mat3(m)) < 0.0f ? -1.0f : 1.0f;
    const glm::dvec3 a(posed.positions[0]), b(posed.positions[1]), c(posed.positions[2]);
    EXPECT_VEC3_NEAR(posed.normals[0], mirrored * glm::vec3(glm::normalize(glm::cross(b - a, c - a))), 1e-3f);
    EXPECT_NEAR(glm::length(posed.normals[0]), 1.0f, 1e-5f);
  }
}

TEST(Origin, IsNearWhatIsFarFromZero) {
  const auto bounds_at = [](float x) { return Bounds{glm::vec3(x - 1, 0, -1), glm::vec3(x + 1, 2, 1)}; };
  for (const float x : {0.0f, 5.0f, 500.0f, -500.0f}) EXPECT_EQ(choose_origin(bounds_at(x)), glm::dvec3(0.0)) << x;
  for (const float x : {1e4f, -1e5f, 1e6f}) {
    const glm::dvec3 origin = choose_origin(bounds_at(x));
    EXPECT_EQ(origin, glm::dvec3(double{x}, 1.0, 0.0));
  }
  // Large scenes stay where they are.
  EXPECT_EQ(choose_origin({glm::vec3(0), glm::vec3(1e5f)}), glm::dvec3(0.0));
  EXPECT_EQ(choose_origin({glm::vec3(-kInfinite), glm::vec3(kInfinite)}), glm::dvec3(0.0));
}

// What a node carries far away and its parent brings back is where it was, and so are lights and cameras.
TEST(Origin, SnapshotsAreRelativeToIt) {
  Scene scene;
  scene.lights.resize(1);
  scene.cameras.resize(1);
  scene.nodes.resize(2);
  scene.nodes[0].translation = {1048576.0f, 0, 0};
  scene.nodes[1].parent = 0;
  scene.nodes[1].translation = {0.1f, 0.2f, 0.3f};
  scene.nodes[1].light = 0;
  scene.nodes[1].camera = 0;
  scene.origin = {1048576.0, 0.0, 0.0};
  const SceneSnapshot snapshot = take_snapshot(scene);
  EXPECT_EQ(snapshot.lights.at(0).position, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(snapshot.cameras.at(0).position, glm::vec3(0.1f, 0.2f, 0.3f));
}

TEST(DefaultCamera, SeesEveryCornerAndFillsTheView) {
  for (const Bounds& bounds :
       {Bounds{glm::vec3(-1), glm::vec3(1)}, Bounds{glm::vec3(-20, 0, 3), glm::vec3(30, 1, 4)},
        Bounds{glm::vec3(2, 0, 0), glm::vec3(3, 100, 9)}, Bounds{glm::vec3(-1e-6f), glm::vec3(1e-6f)}}) {
    const WorldCamera camera = default_camera(bounds);
    const glm::vec3 side = glm::cross(camera.forward, camera.up);
    EXPECT_LT(camera.forward.z, 0.0f);
    EXPECT_GT(camera.position.y, 0.5f * (bounds.minimum.y + bounds.maximum.y));
    EXPECT_FLOAT_EQ(camera.yfov, glm::radians(45.0f));
    float widest = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 p(corner & 1 ? bounds.maximum.x : bounds.minimum.x,
                        corner & 2 ? bounds.maximum.y : bounds.minimum.y,
                        corner & 4 ? bounds.maximum.z : bounds.minimum.z);
      const glm::vec3 d = p - camera.position;
      const float depth = glm::dot(d, camera.forward);
      EXPECT_GT(depth, camera.znear);
      EXPECT_LT(depth, camera.zfar);
      const float off_axis = std::max(std::abs(glm::dot(d, side)), std::abs(glm::dot(d, camera.up)));
      widest = std::max(widest, off_axis / depth / std::tan(camera.yfov / 2.0f));
    }
    EXPECT_LE(widest, 1.0f);
    EXPECT_GT(widest, 0.7f);
  }
}

}  // namespace
}  // namespace lightwell
