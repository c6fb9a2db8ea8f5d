#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "scene/pose.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

TEST(Snapshot, OfAnEmptySceneHasEmptyBounds) {
  const SceneSnapshot snapshot = take_snapshot(Scene());
  EXPECT_TRUE(snapshot.instances.empty());
  EXPECT_EQ(snapshot.bounds.minimum, snapshot.bounds.maximum);
}

// Normals stay perpendicular to their triangles, and on the same side, under stretching, shearing and mirroring.
TEST(Pose, NormalsFollowTheirTriangles) {
  Scene scene;
  Primitive& p = scene.meshes.emplace_back().primitives.emplace_back();
  p.positions = {{0, 0, 0}, {1, 0, 1}, {0, 1, 1}};
  p.normals.assign(3, glm::normalize(glm::vec3(-1, -1, 1)));
  p.indices = {0, 1, 2};
  Node& node = scene.nodes.emplace_back();
  node.mesh = 0;
  const glm::mat4 stretch(3, 0, 0, 0, 0.5f, 1, 0, 0, 0, 0, 0.2f, 0, 5, 6, 7, 1);
  const glm::mat4 mirror(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  for (const glm::mat4& m : {stretch, mirror, mirror * stretch, glm::scale(stretch, glm::vec3(1e-4f))}) {
    node.matrix = m;
    const PosedVertices posed = pose_primitive(scene, world_transforms(scene), 0, p);
    const float mirrored = glm::determinant(glm::mat3(m)) < 0.0f ? -1.0f : 1.0f;
    const glm::dvec3 a(posed.positions[0]), b(posed.positions[1]), c(posed.positions[2]);
    EXPECT_VEC3_NEAR(posed.normals[0], mirrored * glm::vec3(glm::normalize(glm::cross(b - a, c - a))), 1e-3f);
    EXPECT_NEAR(glm::length(posed.normals[0]), 1.0f, 1e-5f);
  }
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
