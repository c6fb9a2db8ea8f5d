#include "passes/gpu_scene/scene_motion.h"

#include <gtest/gtest.h>

#include <set>

namespace lightwell {
namespace {

// Three rigid parts, each an instance of its own; the first is animated.
class SceneMotionTest : public ::testing::Test {
 protected:
  SceneMotionTest() { advance({}); }

  // One frame in which these instances move on.
  void advance(const std::set<std::size_t>& movers) {
    for (const std::size_t i : movers) instances_[i].to_world[3].x += 1.0f;
    motion_.advance({{.instance = 0}, {.instance = 1}, {.instance = 2}}, {true, false, false}, instances_);
  }
  void stand_still(std::uint32_t frames) {
    for (std::uint32_t i = 0; i < frames; ++i) advance({});
  }

  std::vector<MeshInstance> instances_{3, {0, -1, glm::mat4(1)}};
  SceneMotion motion_;
};

TEST_F(SceneMotionTest, OnlyWhatIsAnimatedMovesInTheFirstFrame) {
  EXPECT_EQ(motion_.moving, (std::vector<bool>{true, false, false}));
  EXPECT_EQ(motion_.moved, (std::vector<bool>{false, false, false}));
}

TEST_F(SceneMotionTest, WhatStandsStillLongEnoughIsStaticAgain) {
  advance({0, 2});
  EXPECT_EQ(motion_.moved, (std::vector<bool>{true, false, true}));
  EXPECT_EQ(motion_.moving, (std::vector<bool>{true, false, true}));
  stand_still(kStillFramesUntilStatic);
  EXPECT_EQ(motion_.moving, (std::vector<bool>{true, false, true}));
  advance({});
  EXPECT_EQ(motion_.moving, (std::vector<bool>{true, false, false})) << "animated parts never return";
  advance({2});
  EXPECT_EQ(motion_.moving, (std::vector<bool>{true, false, true}));
}

TEST_F(SceneMotionTest, WhatMovesNowAndThenStaysAmongTheMoving) {
  for (int round = 0; round < 5; ++round) {
    advance({1});
    for (std::uint32_t i = 0; i < kStillFramesUntilStatic; ++i) {
      advance({});
      ASSERT_TRUE(motion_.moving[1]) << "round " << round << " frame " << i;
    }
  }
}

TEST_F(SceneMotionTest, TogetherAtRestTogetherStatic) {
  advance({1, 2});
  advance({1, 2});
  stand_still(kStillFramesUntilStatic);
  EXPECT_EQ(motion_.moving, (std::vector<bool>{true, true, true}));
  advance({});
  EXPECT_EQ(motion_.moving, (std::vector<bool>{true, false, false}));
}

// Whatever comes to rest soon after a return waits for the next.
TEST_F(SceneMotionTest, ReturnsAreApart) {
  advance({1, 2});
  advance({2});
  stand_still(kStillFramesUntilStatic);
  EXPECT_EQ(motion_.moving, (std::vector<bool>{true, false, true}));
  stand_still(kStillFramesUntilStatic);
  EXPECT_EQ(motion_.moving, (std::vector<bool>{true, false, true}));
  advance({});
  EXPECT_EQ(motion_.moving, (std::vector<bool>{true, false, false}));
}

}  // namespace
}  // namespace lightwell
