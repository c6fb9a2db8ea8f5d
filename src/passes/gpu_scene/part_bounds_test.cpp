#include "passes/gpu_scene/part_bounds.h"

#include <gtest/gtest.h>

#include <limits>

#include <glm/ext/matrix_transform.hpp>

namespace lightwell {
namespace {

// Four vertices; joint 0 holds the first two, joint 2 the others.
Primitive skinned_square() {
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  primitive.joints = {{0, 0, 0, 0}, {0, 0, 0, 0}, {2, 0, 0, 0}, {2, 0, 0, 0}};
  primitive.weights.assign(4, {1, 0, 0, 0});
  return primitive;
}

Bounds bound(const Primitive& primitive, const MeshInstance& instance) {
  return bound_part(bound_shape(primitive), instance);
}

void expect_near(const Bounds& found, const Bounds& expected) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(found.minimum[c], expected.minimum[c], 1e-4f);
    EXPECT_NEAR(found.maximum[c], expected.maximum[c], 1e-4f);
  }
}

TEST(PartBounds, RigidPartsFollowTheirNode) {
  Primitive primitive = skinned_square();
  primitive.joints.clear();
  primitive.weights.clear();
  const glm::mat4 quarter_turn = glm::rotate(glm::mat4(1), 1.57079637f, glm::vec3(0, 0, 1));
  const glm::mat4 placed = glm::translate(glm::mat4(1), glm::vec3(10, 20, 30)) * quarter_turn;
  expect_near(bound(primitive, {0, -1, placed}), {{9, 20, 30}, {10, 21, 30}});
}

TEST(PartBounds, JointsCarryOnlyWhatTheyInfluence) {
  MeshInstance instance{0, -1, glm::mat4(1), std::vector<glm::mat4>(3, glm::mat4(1))};
  instance.joints[1] = glm::translate(glm::mat4(1), glm::vec3(100, 0, 0));
  instance.joints[2] = glm::translate(glm::mat4(1), glm::vec3(0, 5, 0));
  expect_near(bound(skinned_square(), instance), {{0, 0, 0}, {1, 6, 0}});
  expect_near(bound(skinned_square(), {0, -1, glm::translate(glm::mat4(1), glm::vec3(0, 0, 7))}),
              {{0, 0, 7}, {1, 1, 7}});
}

TEST(PartBounds, MorphTargetsGrowThemByTheirWeights) {
  Primitive primitive = skinned_square();
  primitive.morph_targets.resize(2);
  primitive.morph_targets[0].positions = {{0, 0, 1}, {0, 0, 0}, {0, 0, 0}, {0, 0, 3}};
  const Bounds at_rest{{0, 0, 0}, {1, 1, 0}};
  expect_near(bound(primitive, {0, -1, glm::mat4(1)}), at_rest);
  expect_near(bound(primitive, {0, -1, glm::mat4(1), {}, {0.0f, 5.0f}}), at_rest);
  expect_near(bound(primitive, {0, -1, glm::mat4(1), {}, {-2.0f}}), {{0, 0, -6}, {1, 1, 0}});
}

// 2 J_0 p - J_2 p is where such weights place a vertex, outside of both joints' places.
TEST(PartBounds, WeightsThatAreNoMeanAreRespected) {
  Primitive primitive = skinned_square();
  primitive.joints.assign(4, {0, 2, 0, 0});
  primitive.weights.assign(4, {2, -1, 0, 0});
  MeshInstance instance{0, -1, glm::mat4(1), std::vector<glm::mat4>(3, glm::mat4(1))};
  instance.joints[2] = glm::translate(glm::mat4(1), glm::vec3(5, 0, 0));
  EXPECT_LE(bound(primitive, instance).minimum.x, -5.0f);
}

TEST(PartBounds, WhatIsNotFiniteIsEverywhere) {
  MeshInstance instance{0, -1, glm::mat4(1)};
  instance.to_world[3].y = std::numeric_limits<float>::quiet_NaN();
  const Bounds bounds = bound(skinned_square(), instance);
  EXPECT_EQ(bounds.minimum, glm::vec3(-std::numeric_limits<float>::infinity()));
  EXPECT_EQ(bounds.maximum, glm::vec3(std::numeric_limits<float>::infinity()));
}

}  // namespace
}  // namespace lightwell
