// The path tracer on a moment of an animation: the same picture as of a scene that was modelled in that pose.
#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "reference/test_scenes.h"

namespace lightwell {
namespace {

constexpr float kMoment = 0.5f;  // seconds
const glm::vec3 kBulge{0.0f, 0.25f, 0.5f};
const glm::vec3 kBulgeOfNormals{0.25f, 0.0f, 0.5f};

// A shining ball on a floor. All coordinates are multiples of 1/256, so that every step of posing it is exact.
TestScene make_ball() {
  TestScene scene;
  scene.add_quad({-4, -2, -4}, {0, 0, 8}, {8, 0, 0}, scene.add_material({0.8f, 0.7f, 0.6f}));
  scene.add_sphere({0, 0, 0}, 1.0f, 8, false, scene.add_material({0.2f, 0.7f, 0.4f}, {1, 2, 0.5f}));
  for (glm::vec3& p : scene.scene.meshes[1].primitives[0].positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] * 256.0f) / 256.0f;
  scene.snapshot.lights.push_back({LightType::kPoint, {2, 3, 1}, {0, 0, -1}, {30, 20, 10}, 1.0f, 0.0f});
  return scene;
}

// Which third of the ball a vertex belongs to: 0 turns with joint 0, 1 is pulled by joints 1 and 2, 2 by joint 2 alone.
int third_of(std::size_t vertex) {
  return static_cast<int>(vertex % 3);
}

// The ball with a morph target and three joints: joint 0 makes half a turn about Y at once, joint 1 moves evenly to
// (2, 0, 0) in a second, joint 2 grows evenly from 1 to 2; the morph target comes evenly.
TestScene make_animated() {
  TestScene moving = make_ball();
  Scene& scene = moving.scene;
  Mesh& ball = scene.meshes[1];
  Primitive& primitive = ball.primitives[0];
  const std::size_t count = primitive.positions.size();
  primitive.morph_targets = {{std::vector<glm::vec3>(count, kBulge), std::vector<glm::vec3>(count, kBulgeOfNormals)}};
  ball.morph_weights = {0.0f};
  const glm::u16vec4 joints[] = {{0, 0, 0, 0}, {1, 2, 0, 0}, {2, 0, 0, 0}};
  const glm::vec4 weights[] = {{1, 0, 0, 0}, {0.5f, 0.5f, 0, 0}, {1, 0, 0, 0}};
  for (std::size_t v = 0; v < count; ++v) {
    primitive.joints.push_back(joints[third_of(v)]);
    primitive.weights.push_back(weights[third_of(v)]);
  }
  scene.skins.push_back({{2, 3, 4}, std::vector<glm::mat4>(3, glm::mat4(1.0f))});
  scene.nodes.resize(5);
  scene.nodes[0].mesh = 0;
  scene.nodes[1].mesh = 1;
  scene.nodes[1].skin = 0;
  scene.nodes[1].translation = {50, 50, 50};  // of no effect
  scene.animations.push_back(
      {"dance",
       {{2, AnimationPath::kRotation, Interpolation::kStep, {0, 0.25f}, {0, 0, 0, 1, 0, 1, 0, 0}},
        {3, AnimationPath::kTranslation, Interpolation::kLinear, {0, 1}, {0, 0, 0, 2, 0, 0}},
        {4, AnimationPath::kScale, Interpolation::kLinear, {0, 1}, {1, 1, 1, 2, 2, 2}},
        {1, AnimationPath::kMorphWeights, Interpolation::kLinear, {0, 1}, {0, 1}}}});
  validate(scene, "test");
  const std::vector<WorldLight> lights = moving.snapshot.lights;
  moving.snapshot = take_snapshot(scene, animate_nodes(scene, scene.animations[0], kMoment));
  moving.snapshot.lights = lights;
  return moving;
}

// The same pose, written down vertex by vertex.
TestScene make_baked() {
  TestScene baked = make_ball();
  Primitive& primitive = baked.scene.meshes[1].primitives[0];
  for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
    const glm::vec3 p = primitive.positions[v] + 0.5f * kBulge, n = primitive.normals[v] + 0.5f * kBulgeOfNormals;
    const glm::vec3 places[] = {{-p.x, p.y, -p.z}, {1.25f * p.x + 0.5f, 1.25f * p.y, 1.25f * p.z}, 1.5f * p};
    primitive.positions[v] = places[third_of(v)];
    primitive.normals[v] = third_of(v) == 0 ? glm::vec3(-n.x, n.y, -n.z) : n;
  }
  return baked;
}

void expect_same(const Image& a, const Image& b) {
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)), 0);
}

TEST(AnimatedScene, LooksAsIfModelledInItsPose) {
  const WorldCamera camera = camera_at({1, 2, 6}, {0, 0, 0}, {0, 1, 0}, 0.8f);
  const PathTracerOptions options = test_options(32, 8, 4);
  const TestScene moving = make_animated();
  const Picture animated = moving.render(camera, options), baked = make_baked().render(camera, options);
  expect_same(animated.combined, baked.combined);
  expect_same(animated.normal, baked.normal);
  expect_same(animated.depth, baked.depth);
  // It did move.
  TestScene still = make_animated();
  still.snapshot = take_snapshot(still.scene);
  still.snapshot.lights = moving.snapshot.lights;
  EXPECT_NE(still.render(camera, options).combined.pixels, animated.combined.pixels);
  expect_same(still.render(camera, options).combined, make_ball().render(camera, options).combined);
}

}  // namespace
}  // namespace lightwell
