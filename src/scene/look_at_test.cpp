// Cameras by place and target.
#include "scene/look_at.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

constexpr Bounds kBounds{{-1, -1, -1}, {1, 1, 1}};

TEST(LookAt, LooksAtItsTargetUpright) {
  const WorldCamera camera = look_at({1, 2, 3}, {4, 2, 7}, kBounds);
  EXPECT_VEC3_NEAR(camera.position, glm::vec3(1, 2, 3), 1e-6f);
  EXPECT_VEC3_NEAR(camera.forward, glm::vec3(0.6f, 0, 0.8f), 1e-6f);
  EXPECT_VEC3_NEAR(camera.up, glm::vec3(0, 1, 0), 1e-6f);
  EXPECT_FLOAT_EQ(camera.yfov, glm::radians(45.0f));
}

TEST(LookAt, HasAnUpDirectionWhereThereIsNoHorizon) {
  for (const float height : {-5.0f, 5.0f}) {
    const WorldCamera camera = look_at({0, height, 0}, {0, 0, 0}, kBounds);
    EXPECT_VEC3_NEAR(camera.up, glm::vec3(0, 0, -1), 1e-6f);
    EXPECT_NEAR(glm::dot(camera.up, camera.forward), 0.0f, 1e-6f);
  }
}

TEST(LookAt, SeesPastTheSceneFromFarAway) {
  EXPECT_GT(look_at({1e5f, 0, 0}, {0, 0, 0}, kBounds).zfar, 1e5f + 1.0f);
}

}  // namespace
}  // namespace lightwell
