// The built-in animated scene keeps what its users count on: the creature moves, smoothly, closes its loop and never
// touches the box, so that a grid over the scene stays where it is.
#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "scene/builtin.h"
#include "scene/pose.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

constexpr int kFrames = 48;
constexpr float kFramesPerSecond = 24.0f;
constexpr float kMargin = 0.004f;  // metres

class CornellDynamic : public testing::Test {
 protected:
  SceneSnapshot at(float seconds) const {
    return take_snapshot(scene_, animate_nodes(scene_, scene_.animations.at(0), seconds));
  }

  // All vertices of the creature: walls alone have no parent and no skin.
  std::vector<glm::vec3> pose_creature(const SceneSnapshot& snapshot) const {
    std::vector<glm::vec3> all;
    for (const MeshInstance& instance : snapshot.instances) {
      const Node& node = scene_.nodes[static_cast<std::size_t>(instance.node)];
      if (node.skin < 0 && node.parent < 0) continue;
      for (const Primitive& p : scene_.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
        const std::vector<glm::vec3> posed = pose_primitive(p, instance).positions;
        all.insert(all.end(), posed.begin(), posed.end());
      }
    }
    return all;
  }

  const Scene scene_ = load_scene(resolve_scene("cornell-dynamic"));
};

float largest_distance(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  float largest = 0.0f;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, glm::length(a[i] - b[i]));
  return largest;
}

TEST_F(CornellDynamic, StaysInsideTheBox) {
  // The box, its left wall where it stands farthest in.
  const glm::vec3 low(kMargin, 0.0f, kMargin);
  const glm::vec3 high = glm::vec3(0.5496f, 0.5488f, 0.5592f) - kMargin;
  const Bounds at_rest = take_snapshot(scene_).bounds;
  for (int frame = 0; frame < kFrames; ++frame) {
    const SceneSnapshot snapshot = at(static_cast<float>(frame) / kFramesPerSecond);
    Bounds bounds{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
    for (const glm::vec3& p : pose_creature(snapshot)) {
      bounds.minimum = glm::min(bounds.minimum, p);
      bounds.maximum = glm::max(bounds.maximum, p);
    }
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(bounds.minimum, low))) << "frame " << frame;
    EXPECT_TRUE(glm::all(glm::lessThanEqual(bounds.maximum, high))) << "frame " << frame;
    for (const WorldLight& light : snapshot.lights) EXPECT_GT(light.position.y, bounds.maximum.y) << "frame " << frame;
    EXPECT_EQ(snapshot.bounds.minimum, at_rest.minimum);
    EXPECT_EQ(snapshot.bounds.maximum, at_rest.maximum);
  }
}

TEST_F(CornellDynamic, EndsWhereItBegan) {
  EXPECT_EQ(animation_end(scene_.animations.at(0)), 2.0f);
  const SceneSnapshot first = at(0.0f), last = at(2.0f);
  EXPECT_LT(largest_distance(pose_creature(first), pose_creature(last)), 1e-6f);
  for (std::size_t i = 0; i < first.lights.size(); ++i) {
    EXPECT_VEC3_NEAR(first.lights[i].position, last.lights[i].position, 1e-6f);
    EXPECT_VEC3_NEAR(first.lights[i].direction, last.lights[i].direction, 1e-6f);
  }
}

// From one frame to the next something moves, and nothing farther than two and a half centimetres.
TEST_F(CornellDynamic, MovesSmoothly) {
  SceneSnapshot before = at(0.0f);
  EXPECT_EQ(before.lights.size(), 2u);
  for (int frame = 1; frame <= kFrames; ++frame) {
    SceneSnapshot now = at(static_cast<float>(frame) / kFramesPerSecond);
    const float distance = largest_distance(pose_creature(before), pose_creature(now));
    EXPECT_GT(distance, 0.003f) << "frame " << frame;
    EXPECT_LT(distance, 0.025f) << "frame " << frame;
    for (std::size_t i = 0; i < now.lights.size(); ++i)
      EXPECT_LT(glm::length(now.lights[i].position - before.lights[i].position), 0.025f) << "frame " << frame;
    before = std::move(now);
  }
}

}  // namespace
}  // namespace lightwell
