#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "scene/test_files.h"

namespace lightwell {
namespace {

// A scene of one node that `channel` moves.
Node pose_at(AnimationChannel channel, float seconds) {
  Scene scene;
  scene.meshes.emplace_back().morph_weights = {0.0f};
  scene.nodes.emplace_back().mesh = 0;
  channel.node = 0;
  scene.animations.push_back({"move", {channel}});
  validate(scene, "test");
  return animate_nodes(scene, scene.animations[0], seconds)[0];
}

TEST(Animation, HoldsBeforeTheFirstAndAfterTheLastKey) {
  for (const Interpolation how : {Interpolation::kStep, Interpolation::kLinear}) {
    const AnimationChannel c{0, AnimationPath::kTranslation, how, {1, 2}, {1, 2, 3, 4, 5, 6}};
    EXPECT_VEC3_NEAR(pose_at(c, -5).translation, glm::vec3(1, 2, 3), 0.0f);
    EXPECT_VEC3_NEAR(pose_at(c, 1).translation, glm::vec3(1, 2, 3), 0.0f);
    EXPECT_VEC3_NEAR(pose_at(c, 2).translation, glm::vec3(4, 5, 6), 0.0f);
    EXPECT_VEC3_NEAR(pose_at(c, 9).translation, glm::vec3(4, 5, 6), 0.0f);
    EXPECT_EQ(animation_end({"", {c}}), 2.0f);
  }
}

TEST(Animation, TakesAnyMoment) {
  const AnimationChannel c{0, AnimationPath::kTranslation, Interpolation::kLinear, {-3e38f, 3e38f}, {0, 0, 0, 4, 0, 0}};
  EXPECT_VEC3_NEAR(pose_at(c, 0).translation, glm::vec3(2, 0, 0), 1e-6f);
  EXPECT_VEC3_NEAR(pose_at(c, -HUGE_VALF).translation, glm::vec3(0), 0.0f);
  EXPECT_VEC3_NEAR(pose_at(c, HUGE_VALF).translation, glm::vec3(4, 0, 0), 0.0f);
}

// Between two keys that single precision just tells apart the way is smooth.
TEST(Animation, FarFromZeroTheWayIsSmooth) {
  const AnimationChannel c{
      0, AnimationPath::kTranslation, Interpolation::kLinear, {0, 1}, {1e6f, 0, 0, 1e6f + 0.0625f, 0, 0}};
  for (const float t : {0.125f, 0.5f, 0.75f}) EXPECT_EQ(pose_at(c, t).translation.x, 1e6 + 0.0625 * t);
}

TEST(Animation, StepsAndLines) {
  AnimationChannel c{0, AnimationPath::kScale, Interpolation::kStep, {0, 4}, {1, 1, 1, 3, 5, 7}};
  EXPECT_VEC3_NEAR(pose_at(c, 3.9f).scale, glm::vec3(1), 0.0f);
  c.interpolation = Interpolation::kLinear;
  EXPECT_VEC3_NEAR(pose_at(c, 1).scale, glm::vec3(1.5f, 2, 2.5f), 1e-6f);
}

TEST(Animation, RotationsTurnEvenly) {
  // A quarter turn about Y in one second; the second key is given with the opposite sign, which is the same rotation.
  const float h = std::sqrt(0.5f);
  const AnimationChannel c{0, AnimationPath::kRotation, Interpolation::kLinear, {0, 1}, {0, 0, 0, 1, 0, -h, 0, -h}};
  for (const float t : {0.0f, 0.2f, 0.5f, 1.0f}) {
    const glm::quat q = pose_at(c, t).rotation;
    EXPECT_NEAR(std::abs(q.w), std::cos(t * 0.25f * std::numbers::pi_v<float>), 1e-5f);
    EXPECT_NEAR(glm::length(glm::vec4(q.x, q.y, q.z, q.w)), 1.0f, 1e-5f);
  }
}

// A cubic polynomial is its own spline.
TEST(Animation, SplinesReproduceCubics) {
  const auto f = [](float t) { return 1 + 2 * t - t * t + 0.5f * t * t * t; };
  const auto slope = [](float t) { return 2 - 2 * t + 1.5f * t * t; };
  AnimationChannel c{0, AnimationPath::kMorphWeights, Interpolation::kCubicSpline, {}, {}};
  for (const float t : {0.0f, 0.5f, 3.0f}) {
    c.times.push_back(t);
    c.values.insert(c.values.end(), {slope(t), f(t), slope(t)});
  }
  for (const float t : {0.0f, 0.1f, 0.5f, 1.7f, 3.0f}) EXPECT_NEAR(pose_at(c, t).morph_weights.at(0), f(t), 1e-4f) << t;
}

}  // namespace
}  // namespace lightwell
