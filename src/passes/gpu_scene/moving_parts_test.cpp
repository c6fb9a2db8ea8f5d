#include "passes/gpu_scene/moving_parts.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

namespace lightwell {
namespace {

Primitive triangle() {
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  primitive.normals.assign(3, {0, 0, 1});
  primitive.indices = {0, 1, 2};
  return primitive;
}

Primitive skinned_triangle() {
  Primitive primitive = triangle();
  primitive.joints.assign(3, {0, 1, 0, 0});
  primitive.weights.assign(3, {0.5f, 0.5f, 0, 0});
  return primitive;
}

// Nodes 0 <- 1 <- 2 and 3, a node by itself; all show mesh 0.
Scene family() {
  Scene scene;
  scene.meshes.push_back({"plain", {triangle()}, {}});
  scene.nodes.resize(4);
  scene.nodes[1].parent = 0;
  scene.nodes[2].parent = 1;
  for (Node& node : scene.nodes) node.mesh = 0;
  return scene;
}

void animate(Scene& scene, int node, AnimationPath path) {
  AnimationChannel channel;
  channel.node = node;
  channel.path = path;
  scene.animations.push_back({"", {channel}});
}

std::vector<bool> list_animated_parts_of(const Scene& scene) {
  return list_animated_parts(scene, take_snapshot(scene).instances);
}

TEST(MovingParts, WithoutAnimationNothingMoves) {
  EXPECT_EQ(list_animated_parts_of(family()), std::vector<bool>(4, false));
}

TEST(MovingParts, ChildrenFollowTheirAnimatedNode) {
  Scene scene = family();
  animate(scene, 1, AnimationPath::kRotation);
  EXPECT_EQ(list_animated_parts_of(scene), (std::vector<bool>{false, true, true, false}));
}

TEST(MovingParts, WeightsMoveOnlyPrimitivesWithTargets) {
  Scene scene = family();
  Primitive morphed = triangle();
  morphed.morph_targets = {{std::vector<glm::vec3>(3, glm::vec3(1)), {}}};
  scene.meshes.push_back({"morphed", {triangle(), morphed}, {0.0f}});
  scene.nodes[1].mesh = 1;
  animate(scene, 1, AnimationPath::kMorphWeights);
  EXPECT_EQ(list_animated_parts_of(scene), (std::vector<bool>{false, false, true, false, false}));
}

TEST(MovingParts, SkinnedPrimitivesFollowTheirJointsAndNotTheirNode) {
  Scene scene = family();
  scene.skins.push_back({{2, 3}, std::vector<glm::mat4>(2, glm::mat4(1))});
  scene.meshes.push_back({"skinned", {triangle(), skinned_triangle()}, {}});
  Node shown;
  shown.mesh = 1;
  shown.skin = 0;
  scene.nodes.push_back(shown);
  Scene joint_moves = scene;
  animate(joint_moves, 1, AnimationPath::kTranslation);
  EXPECT_EQ(list_animated_parts_of(joint_moves), (std::vector<bool>{false, true, true, false, false, true}));
  Scene node_moves = scene;
  animate(node_moves, 4, AnimationPath::kTranslation);
  EXPECT_EQ(list_animated_parts_of(node_moves), (std::vector<bool>{false, false, false, false, true, false}));
}

TEST(MovingParts, MovedInstancesAreFound) {
  const Scene scene = family();
  const std::vector<MeshInstance> before = take_snapshot(scene).instances;
  const std::vector<FlatPart> parts = flatten_geometry(scene, before, std::vector<bool>(4)).parts;
  EXPECT_EQ(list_moved_parts(parts, before, before), std::vector<bool>(4, false));
  std::vector<MeshInstance> after = before;
  after[2].to_world = glm::translate(glm::mat4(1), glm::vec3(0, 1e-6f, 0));
  EXPECT_EQ(list_moved_parts(parts, before, after), (std::vector<bool>{false, false, true, false}));
}

TEST(MovingParts, PosesMoveWhatTheyDeform) {
  Scene scene;
  Primitive morphed = triangle();
  morphed.morph_targets.resize(1);
  scene.meshes.push_back({"all kinds", {triangle(), skinned_triangle(), morphed}, {0.0f}});
  const std::vector<MeshInstance> rest{{0, -1, glm::mat4(1), {glm::mat4(1), glm::mat4(1)}, {0.0f}}};
  const std::vector<FlatPart> parts = flatten_geometry(scene, rest, std::vector<bool>(3)).parts;
  std::vector<MeshInstance> now = rest;
  now[0].to_world[3].x = 1.0f;
  EXPECT_EQ(list_moved_parts(parts, rest, now), (std::vector<bool>{true, false, true}));
  now = rest;
  now[0].joints[1][3].x = 1.0f;
  EXPECT_EQ(list_moved_parts(parts, rest, now), (std::vector<bool>{false, true, false}));
  now = rest;
  now[0].morph_weights[0] = 0.5f;
  EXPECT_EQ(list_moved_parts(parts, rest, now), (std::vector<bool>{false, false, true}));
}

}  // namespace
}  // namespace lightwell
