// The built-in animated scene keeps what its users count on: the creature moves, smoothly, closes its loop and never
// touches the box, so that a grid over the scene stays where it is.
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/animation.h"
#include "scene/builtin.h"
#include "scene/pose.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

constexpr int kFrames = 48;
constexpr float kFramesPerSecond = 24.0f;
constexpr float kMargin = 0.004f;  // metres

const Scene& scene_at(float seconds) {
  static Scene scene = load_scene(resolve_scene("cornell-dynamic"));
  apply_animation(scene, scene.animations.at(0), seconds);
  return scene;
}

// Walls have no parent.
bool belongs_to_creature(const Node& node) {
  return node.mesh >= 0 && (node.skin >= 0 || node.parent >= 0);
}

// All vertices of the creature.
std::vector<glm::vec3> pose_creature(const Scene& scene) {
  std::vector<glm::vec3> all;
  const std::vector<glm::mat4> world = world_transforms(scene);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (!belongs_to_creature(scene.nodes[i])) continue;
    for (const Primitive& p : scene.meshes[static_cast<std::size_t>(scene.nodes[i].mesh)].primitives) {
      const PosedVertices posed = pose_primitive(scene, world, static_cast<int>(i), p);
      all.insert(all.end(), posed.positions.begin(), posed.positions.end());
    }
  }
  return all;
}

float largest_distance(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  float largest = 0.0f;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, glm::length(a[i] - b[i]));
  return largest;
}

TEST(CornellDynamic, HasSkinsMorphTargetsMovingLightsAndEveryInterpolation) {
  const Scene scene = load_scene(resolve_scene("cornell-dynamic"));
  EXPECT_EQ(scene.skins.size(), 6u);
  std::vector<bool> has_path(4), has_interpolation(3);
  for (const AnimationChannel& channel : scene.animations.at(0).channels) {
    has_path[static_cast<std::size_t>(channel.path)] = true;
    has_interpolation[static_cast<std::size_t>(channel.interpolation)] = true;
  }
  EXPECT_EQ(has_path, (std::vector<bool>{true, true, false, true}));  // nothing is scaled
  EXPECT_EQ(has_interpolation, (std::vector<bool>{true, true, true}));
  EXPECT_EQ(take_snapshot(scene).lights.size(), 2u);
}

TEST(CornellDynamic, StaysInsideTheBox) {
  // The box, its left wall where it stands farthest in.
  const glm::vec3 low(kMargin, 0.0f, kMargin);
  const glm::vec3 high(0.5496f - kMargin, 0.5488f - kMargin, 0.5592f - kMargin);
  const Bounds at_rest = take_snapshot(scene_at(0.0f)).bounds;
  for (int frame = 0; frame < kFrames; ++frame) {
    const Scene& scene = scene_at(static_cast<float>(frame) / kFramesPerSecond);
    Bounds bounds{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
    for (const glm::vec3& p : pose_creature(scene)) {
      bounds.minimum = glm::min(bounds.minimum, p);
      bounds.maximum = glm::max(bounds.maximum, p);
    }
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(bounds.minimum, low))) << "frame " << frame;
    EXPECT_TRUE(glm::all(glm::lessThanEqual(bounds.maximum, high))) << "frame " << frame;
    for (const WorldLight& light : take_snapshot(scene).lights)
      EXPECT_GT(light.position.y, bounds.maximum.y) << "frame " << frame;
    const Bounds all = take_snapshot(scene).bounds;
    EXPECT_EQ(all.minimum, at_rest.minimum);
    EXPECT_EQ(all.maximum, at_rest.maximum);
  }
}

TEST(CornellDynamic, EndsWhereItBegan) {
  EXPECT_EQ(animation_end(scene_at(0.0f).animations.at(0)), 2.0f);
  const std::vector<glm::vec3> first = pose_creature(scene_at(0.0f));
  const std::vector<WorldLight> first_lights = take_snapshot(scene_at(0.0f)).lights;
  EXPECT_LT(largest_distance(first, pose_creature(scene_at(2.0f))), 1e-6f);
  const std::vector<WorldLight> last_lights = take_snapshot(scene_at(2.0f)).lights;
  for (std::size_t i = 0; i < first_lights.size(); ++i) {
    EXPECT_VEC3_NEAR(first_lights[i].position, last_lights[i].position, 1e-6f);
    EXPECT_VEC3_NEAR(first_lights[i].direction, last_lights[i].direction, 1e-6f);
  }
}

// From one frame to the next something moves, and nothing farther than two and a half centimetres.
TEST(CornellDynamic, MovesSmoothly) {
  std::vector<glm::vec3> before = pose_creature(scene_at(0.0f));
  std::vector<WorldLight> lights_before = take_snapshot(scene_at(0.0f)).lights;
  for (int frame = 1; frame <= kFrames; ++frame) {
    const Scene& scene = scene_at(static_cast<float>(frame) / kFramesPerSecond);
    std::vector<glm::vec3> now = pose_creature(scene);
    EXPECT_GT(largest_distance(before, now), 0.003f) << "frame " << frame;
    EXPECT_LT(largest_distance(before, now), 0.025f) << "frame " << frame;
    before = std::move(now);
    const std::vector<WorldLight> lights = take_snapshot(scene).lights;
    for (std::size_t i = 0; i < lights.size(); ++i)
      EXPECT_LT(glm::length(lights[i].position - lights_before[i].position), 0.025f) << "frame " << frame;
    lights_before = lights;
  }
}

}  // namespace
}  // namespace lightwell
