#include "reference/flat_scene.h"

#include <gtest/gtest.h>
#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "reference/lights.h"
#include "reference/test_scenes.h"

namespace lightwell {
namespace {

TEST(FlatScene, MirroringKeepsTheFrontInFront) {
  TestScene scene;
  scene.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, -1);  // front: +Z
  scene.snapshot.instances[0].to_world = glm::scale(glm::mat4{1.0f}, {-2.0f, 3.0f, 0.5f});
  const FlatScene flat = flatten(scene.scene, scene.snapshot);
  ASSERT_EQ(flat.triangles.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(glm::normalize(flat.area_normal(i)), glm::vec3(0, 0, 1));
    EXPECT_EQ(flat.corner(i, 0).normal, glm::vec3(0, 0, 1));
    EXPECT_FLOAT_EQ(glm::length(flat.area_normal(i)), 6.0f);
  }
}

// The normal of the plane x = y after stretching x by two is (1, -2, 0) / sqrt(5).
TEST(FlatScene, NormalsFollowUnevenScale) {
  TestScene scene;
  scene.add_quad({0, 0, 0}, {1, 1, 0}, {0, 0, 1}, -1);
  scene.snapshot.instances[0].to_world = glm::scale(glm::mat4{1.0f}, {2.0f, 1.0f, 1.0f});
  const FlatScene flat = flatten(scene.scene, scene.snapshot);
  EXPECT_LT(glm::length(flat.corner(0, 0).normal - glm::normalize(glm::vec3(1, -2, 0))), 1e-6f);
  EXPECT_LT(glm::length(glm::normalize(flat.area_normal(0)) - flat.corner(0, 0).normal), 1e-6f);
}

TEST(FlatScene, DropsDegenerateAndSortsMaskedLast) {
  TestScene scene;
  const int opaque = scene.add_material(glm::vec3{1.0f});
  const int masked = scene.add_material(glm::vec3{1.0f});
  scene.scene.materials[static_cast<std::size_t>(masked)].alpha_mode = AlphaMode::kMask;
  scene.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, masked);
  scene.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, opaque);
  scene.scene.meshes[1].primitives[0].indices.insert(scene.scene.meshes[1].primitives[0].indices.end(),
                                                     {0, 0, 1, 1, 2, 2});
  const FlatScene flat = flatten(scene.scene, scene.snapshot);
  ASSERT_EQ(flat.triangles.size(), 4u);
  EXPECT_EQ(flat.opaque_count, 2u);
  EXPECT_EQ(flat.material(0).alpha_mode, AlphaMode::kOpaque);
  EXPECT_EQ(flat.material(2).alpha_mode, AlphaMode::kMask);
}

TEST(FlatScene, MorphsAndSkinsAsTheInstanceSays) {
  TestScene scene;
  scene.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, -1);
  Primitive& quad = scene.scene.meshes[0].primitives[0];
  quad.morph_targets.push_back({std::vector<glm::vec3>(4, {0, 0, 4}), {}});
  MeshInstance& instance = scene.snapshot.instances[0];
  instance.morph_weights = {0.5f};
  EXPECT_EQ(flatten(scene.scene, scene.snapshot).corner(0, 0).position, glm::vec3(0, 0, 2));

  instance.to_world = glm::translate(glm::mat4{1.0f}, {0, 7, 0});
  instance.joints = {glm::translate(glm::mat4{1.0f}, {10, 0, 0})};
  // Without joints of its own the primitive goes with the node, with them it ignores the node.
  EXPECT_EQ(flatten(scene.scene, scene.snapshot).corner(0, 0).position, glm::vec3(0, 7, 2));
  quad.joints.assign(4, glm::u16vec4{0});
  quad.weights.assign(4, glm::vec4{1, 0, 0, 0});
  EXPECT_EQ(flatten(scene.scene, scene.snapshot).corner(0, 0).position, glm::vec3(10, 0, 2));
}

Texture two_by_one(Wrap wrap) {
  Texture texture;
  texture.width = 2;
  texture.height = 1;
  texture.rgba = {0, 0, 0, 0, 255, 255, 255, 255};
  texture.wrap_u = wrap;
  return texture;
}

TEST(Texturing, InterpolatesBetweenTexelCentres) {
  const Texture texture = two_by_one(Wrap::kClampToEdge);
  EXPECT_FLOAT_EQ(sample_texture(texture, {0.25f, 0.5f}).r, 0.0f);
  EXPECT_FLOAT_EQ(sample_texture(texture, {0.5f, 0.5f}).r, 0.5f);
  EXPECT_FLOAT_EQ(sample_texture(texture, {0.625f, 0.5f}).a, 0.75f);
  EXPECT_FLOAT_EQ(sample_texture(texture, {0.75f, -3.0f}).r, 1.0f);
}

TEST(Texturing, Wraps) {
  EXPECT_FLOAT_EQ(sample_texture(two_by_one(Wrap::kClampToEdge), {0.0f, 0.0f}).r, 0.0f);
  EXPECT_FLOAT_EQ(sample_texture(two_by_one(Wrap::kClampToEdge), {7.0f, 0.0f}).r, 1.0f);
  EXPECT_FLOAT_EQ(sample_texture(two_by_one(Wrap::kRepeat), {0.0f, 0.0f}).r, 0.5f);
  EXPECT_FLOAT_EQ(sample_texture(two_by_one(Wrap::kRepeat), {-0.25f, 0.0f}).r, 1.0f);
  EXPECT_FLOAT_EQ(sample_texture(two_by_one(Wrap::kRepeat), {5.25f, 0.0f}).r, 0.0f);
  EXPECT_FLOAT_EQ(sample_texture(two_by_one(Wrap::kMirroredRepeat), {0.0f, 0.0f}).r, 0.0f);
  EXPECT_FLOAT_EQ(sample_texture(two_by_one(Wrap::kMirroredRepeat), {1.25f, 0.0f}).r, 1.0f);
  EXPECT_FLOAT_EQ(sample_texture(two_by_one(Wrap::kMirroredRepeat), {-0.375f, 0.0f}).r, 0.25f);
}

TEST(Texturing, TakesAnyCoordinate) {
  for (const Wrap wrap : {Wrap::kRepeat, Wrap::kMirroredRepeat, Wrap::kClampToEdge}) {
    for (const float u : {1e30f, -1e30f, HUGE_VALF, -HUGE_VALF, std::nanf(""), -1e-20f, 1.0f, 2.0f}) {
      const float value = sample_texture(two_by_one(wrap), {u, u}).r;
      EXPECT_TRUE(value >= 0.0f && value <= 1.0f) << u;
    }
  }
}

TEST(FlatScene, VertexColorsAreWhiteWhereAPrimitiveHasNone) {
  Scene scene;
  scene.meshes.resize(1);
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  primitive.normals.assign(3, {0, 0, 1});
  primitive.indices = {0, 1, 2};
  scene.meshes[0].primitives.assign(3, primitive);
  scene.nodes.resize(1);
  scene.nodes[0].mesh = 0;
  EXPECT_TRUE(flatten(scene, take_snapshot(scene)).colors.empty());
  scene.meshes[0].primitives[1].colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 0}};
  const FlatScene flat = flatten(scene, take_snapshot(scene));
  EXPECT_EQ(flat.color(0, 0.3f, 0.3f), glm::vec4(1.0f));
  EXPECT_EQ(flat.color(2, 0.3f, 0.3f), glm::vec4(1.0f));
  const glm::vec4 mixed = flat.color(1, 0.25f, 0.5f);
  EXPECT_LT(glm::length(mixed - glm::vec4(0.25f, 0.25f, 0.5f, 0.5f)), 1e-6f);
}

TEST(Illuminate, RangesDimAndEnd) {
  WorldLight light;
  light.intensity = glm::vec3(8.0f);
  const auto irradiance = [&](float distance) { return illuminate(light, {distance, 0, 0}).irradiance.x; };
  EXPECT_FLOAT_EQ(irradiance(2.0f), 2.0f);
  light.range = 4.0f;
  EXPECT_FLOAT_EQ(irradiance(2.0f), 2.0f * (1.0f - 1.0f / 16.0f));
  EXPECT_EQ(irradiance(4.0f), 0.0f);
  EXPECT_EQ(irradiance(400.0f), 0.0f);
}

TEST(Texturing, NearestDoesNotInterpolate) {
  Texture texture = two_by_one(Wrap::kRepeat);
  texture.nearest = true;
  EXPECT_EQ(sample_texture(texture, {0.499f, 0.5f}).r, 0.0f);
  EXPECT_EQ(sample_texture(texture, {0.501f, 0.5f}).r, 1.0f);
}

TEST(Texturing, TransformAndTexcoordSet) {
  Scene scene;
  scene.textures.push_back(two_by_one(Wrap::kClampToEdge));
  Material material;
  material.base_color = {0.5f, 1.0f, 1.0f, 1.0f};
  material.base_color_texture.texture = 0;
  material.base_color_texture.texcoord = 1;
  material.base_color_texture.transform = {0.5f, 0.0f, 0.0f, 1.0f, 0.25f, 0.0f};  // u' = u / 2 + 1/4
  const TexcoordSets texcoords{glm::vec2{0.0f}, glm::vec2{1.0f, 0.0f}};
  EXPECT_FLOAT_EQ(base_color(scene, material, texcoords).r, 0.5f);
  EXPECT_FLOAT_EQ(base_color(scene, material, {glm::vec2{1.0f}, glm::vec2{0.5f, 0.0f}}).g, 0.5f);
}

}  // namespace
}  // namespace lightwell
