#include "passes/focus/focus_balls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace lightwell {
namespace {

Bounds ground(float side) {
  return {{-0.5f * side, -1.0f, -0.5f * side}, {0.5f * side, 3.0f, 0.5f * side}};
}

TEST(FocusBalls, SmallScenesHaveNone) {
  EXPECT_TRUE(make_focus_balls(ground(40.0f), glm::vec3(0.0f), {}, {}).empty());
  EXPECT_TRUE(make_focus_balls({}, glm::vec3(0.0f), {}, {}).empty());
  Bounds broken = ground(1000.0f);
  broken.maximum.x = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(make_focus_balls(broken, glm::vec3(0.0f), {}, {}).empty());
}

TEST(FocusBalls, ReachFromTheFocusToTheScene) {
  for (const float side : {50.0f, 100.0f, 1000.0f, 1e4f, 1e6f}) {
    const std::vector<FocusBall> balls = make_focus_balls(ground(side), {0.3f * side, 1.0f, 0.1f}, {}, {});
    ASSERT_GE(balls.size(), 1u);
    ASSERT_LE(balls.size(), kMostFocusBalls);
    EXPECT_EQ(balls[0].radius, kFinestFocus);
    const float ratio = balls.size() > 1 ? balls[1].radius / balls[0].radius : 4.0f;
    for (std::size_t k = 0; k < balls.size(); ++k) {
      EXPECT_LT(glm::distance(balls[k].center, {0.3f * side, 1.0f, 0.1f}), 0.3f * balls[k].radius);
      EXPECT_LT(balls[k].radius, 0.25f * side);
    }
    EXPECT_GT(balls.back().radius * ratio, std::sqrt(2.0f) / 6.0f * side);
  }
}

TEST(FocusBalls, StayWhileTheFocusMovesALittle) {
  const Bounds bounds = ground(1000.0f);
  std::vector<FocusBall> balls = make_focus_balls(bounds, glm::vec3(0.0f), {}, {});
  int moves = 0;
  for (int step = 0; step < 1000; ++step) {  // 10 m
    const glm::vec3 focus(0.01f * static_cast<float>(step), 1.0f, 0.0f);
    const std::vector<FocusBall> next = make_focus_balls(bounds, focus, {}, balls);
    if (next[0] != balls[0]) ++moves;
    EXPECT_LT(glm::distance(next[0].center, focus), 0.3f * kFinestFocus);
    balls = next;
  }
  EXPECT_LE(moves, 6);
  // To and fro over the border between two centres.
  const FocusBall there = balls[0];
  for (const float x : {9.9f, 9.0f, 9.9f, 9.1f}) balls = make_focus_balls(bounds, {x, 1.0f, 0.0f}, {}, balls);
  EXPECT_EQ(balls[0], there);
}

TEST(FocusBalls, ARegionIsTheFinest) {
  const Bounds room{{-3, -1, -3}, {3, 4, 3}};
  const std::vector<FocusBall> balls = make_focus_balls(ground(1000.0f), {100, 0, 0}, room, {});
  EXPECT_EQ(balls[0].center, glm::vec3(0.0f, 1.5f, 0.0f));
  EXPECT_FLOAT_EQ(balls[0].radius, 0.5f * glm::length(glm::vec3(6, 5, 6)));
  EXPECT_EQ(make_focus_balls(ground(40.0f), {10, 0, 0}, room, {}).size(), 1u);
  EXPECT_EQ(make_focus_balls(ground(1000.0f), {100, 0, 0}, ground(400.0f), {})[0].radius, kFinestFocus);
}

}  // namespace
}  // namespace lightwell
