// Skins and morph targets of glTF files: what vertices do in the world, against forms worked out by hand.
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "scene/pose.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

constexpr float kTolerance = 1e-5f;

std::string number(int value) {
  return std::to_string(value);
}

// One triangle's vertices; the tests look at the first.
const std::vector<float> kTriangle = {1, 2, 0, 2, 2, 0, 1, 3, 0};

class GltfSkin : public testing::Test {
 protected:
  // The same four joints or weights at every vertex.
  template <typename T>
  std::string influences(const std::vector<T>& four, int component_type, bool normalized = false) {
    std::vector<T> all;
    for (int v = 0; v < 3; ++v) all.insert(all.end(), four.begin(), four.end());
    return number(builder_.accessor(R"("type":"VEC4","count":3,"componentType":)" + number(component_type) +
                                    (normalized ? R"(,"normalized":true)" : "") + R"(,"bufferView":)" +
                                    number(builder_.view(all))));
  }
  std::string bytes(const std::vector<std::uint8_t>& joints) { return influences(joints, 5121); }
  std::string floats(const std::vector<float>& weights) { return influences(weights, 5126); }

  // A mesh far off, skinned to nodes 1 (at x = 10), its child 2 (at x = 10, y = 3) and 3 (at z = 5).
  Scene load(const std::string& attributes, const std::string& skin = "", const std::string& more = "") {
    const std::string position = number(builder_.vec3(kTriangle));
    return folder_.load(
        "a.gltf",
        builder_.text(
            R"("nodes":[{"mesh":0,"skin":0,"translation":[7,7,7],"scale":[9,9,9]},{"translation":[10,0,0],"children":[2]},
        {"translation":[0,3,0]},{"translation":[0,0,5]}],"skins":[{"joints":[1,2,3])" +
            skin + R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" + position + attributes + "}}]}]" +
            more));
  }
  std::string skinned_to(const std::string& joints, const std::string& weights, int set = 0) {
    return R"(,"JOINTS_)" + number(set) + R"(":)" + joints + R"(,"WEIGHTS_)" + number(set) + R"(":)" + weights;
  }

  static glm::vec3 first_vertex(const Scene& scene, const SceneSnapshot& snapshot) {
    return pose_positions(first_primitive(scene), snapshot.instances.at(0)).at(0);
  }
  static glm::vec3 first_vertex(const Scene& scene) { return first_vertex(scene, take_snapshot(scene)); }

  TempFolder folder_;
  GltfBuilder builder_;
};

// Places of the vertex (1, 2, 0) under the three joints, without inverse bind matrices.
const glm::vec3 kUnder0(11, 2, 0), kUnder1(11, 5, 0), kUnder2(1, 2, 5);

TEST_F(GltfSkin, WithoutInverseBindMatricesJointsMoveFromTheOrigin) {
  for (const char* skin : {"", R"(,"skeleton":1)", R"(,"skeleton":3)"}) {
    const Scene scene = load(skinned_to(bytes({1, 0, 0, 0}), floats({1, 0, 0, 0})), skin);
    EXPECT_VEC3_NEAR(first_vertex(scene), kUnder1, kTolerance);
  }
}

TEST_F(GltfSkin, InverseBindMatricesComeFirst) {
  const std::string bind =
      number(builder_.floats("MAT4", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1, 2, 0, 0, 0, 0, 2, 0, 0,
                                          0, 0, 2, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0,  1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
  const Scene scene =
      load(skinned_to(bytes({0, 1, 0, 0}), floats({0.5f, 0.5f, 0, 0})), R"(,"inverseBindMatrices":)" + bind);
  // (1 - 1 + 10, 2, 0) and (2 * 1 + 10, 2 * 2 + 3, 0)
  EXPECT_VEC3_NEAR(first_vertex(scene), glm::vec3(11, 4.5f, 0), kTolerance);
}

TEST_F(GltfSkin, JointsAndWeightsOfEveryTypeMeanTheSame) {
  const glm::vec3 expected = (191.0f * kUnder1 + 64.0f * kUnder2) / 255.0f;
  const std::string narrow = bytes({1, 2, 0, 0});
  const std::string wide = influences(std::vector<std::uint16_t>{1, 2, 0, 0}, 5123);
  for (const std::string& joints : {narrow, wide}) {
    const std::string as_bytes = influences(std::vector<std::uint8_t>{191, 64, 0, 0}, 5121, true);
    const std::string as_words = influences(std::vector<std::uint16_t>{191 * 257, 64 * 257, 0, 0}, 5123, true);
    const std::string as_floats = floats({191.0f / 255.0f, 64.0f / 255.0f, 0, 0});
    const std::string twice = floats({382.0f, 128.0f, 0, 0});  // the sum does not matter
    const std::string signs = floats({191.0f, 64.0f, -8, 0});  // what is negative counts nothing
    for (const std::string& weights : {as_bytes, as_words, as_floats, twice, signs})
      EXPECT_VEC3_NEAR(first_vertex(load(skinned_to(joints, weights))), expected, kTolerance);
  }
}

TEST_F(GltfSkin, WithoutWeightsTheFirstJointHolds) {
  EXPECT_VEC3_NEAR(first_vertex(load(skinned_to(bytes({0, 0, 0, 0}), floats({0, 0, 0, 0})))), kUnder0, kTolerance);
  // Unused influences may name any joint.
  EXPECT_VEC3_NEAR(first_vertex(load(skinned_to(bytes({1, 200, 201, 202}), floats({1, 0, 0, 0})))), kUnder1,
                   kTolerance);
}

TEST_F(GltfSkin, OfMoreThanFourInfluencesTheLargestFourCount) {
  // 1, 1, 2, 3 of joints 0, 0, 1, 2; 0.5 and 0.25 of joint 2 are left out.
  const std::string first = skinned_to(bytes({2, 0, 1, 0}), floats({0.5f, 1, 2, 0}));
  const std::string second = skinned_to(bytes({0, 2, 2, 0}), floats({1, 3, 0.25f, 0}), 1);
  EXPECT_VEC3_NEAR(first_vertex(load(first + second)), (2.0f * kUnder0 + 2.0f * kUnder1 + 3.0f * kUnder2) / 7.0f,
                   kTolerance);
  EXPECT_VEC3_NEAR(first_vertex(load(first)), (0.5f * kUnder2 + kUnder0 + 2.0f * kUnder1) / 3.5f, kTolerance);
}

TEST_F(GltfSkin, AMeshWithoutJointsGoesWithItsNode) {
  EXPECT_VEC3_NEAR(first_vertex(load("")), glm::vec3(7 + 9, 7 + 18, 7), kTolerance);
}

// An arm: the shoulder (joint 0) turns about Z, the elbow (joint 1, 3 m along) about Z as well.
TEST_F(GltfSkin, AnimatedJointsBendTheMesh) {
  const std::string bind =
      number(builder_.floats("MAT4", 16, {1, 0, 0, 0, 0, 1,  0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0,
                                          0, 0, 1, 0, 0, -3, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
  const float h = std::sqrt(0.5f);
  const std::string times = number(builder_.floats("SCALAR", 1, {0, 1}));
  const std::string turn = number(builder_.floats("VEC4", 4, {0, 0, 0, 1, 0, 0, h, h}));
  const Scene scene =
      load(skinned_to(bytes({0, 1, 0, 0}), floats({0.25f, 0.75f, 0, 0})), R"(,"inverseBindMatrices":)" + bind,
           R"(,"animations":[{"channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}},
      {"sampler":0,"target":{"node":2,"path":"rotation"}}],"samplers":[{"input":)" +
               times + R"(,"output":)" + turn + "}]}]");
  for (double t = 0.0; t <= 1.0; t += 0.125) {
    const SceneSnapshot snapshot =
        take_snapshot(scene, animate_nodes(scene, scene.animations.at(0), static_cast<float>(t)));
    const double angle = t * std::acos(0.0);
    const auto turned = [](double a, const glm::dvec2& p) {
      return glm::dvec2(std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y);
    };
    const glm::dvec2 shoulder(10, 0), elbow = shoulder + turned(angle, {0, 3});
    const glm::dvec2 upper = shoulder + turned(angle, {1, 2}), lower = elbow + turned(2 * angle, {1, 2 - 3});
    const glm::dvec2 expected = 0.25 * upper + 0.75 * lower;
    EXPECT_VEC3_NEAR(first_vertex(scene, snapshot), glm::vec3(glm::vec2(expected), 0.0f), kTolerance);
    // The normal stays: all turns are about it.
    EXPECT_VEC3_NEAR(pose_primitive(first_primitive(scene), snapshot.instances.at(0)).normals.at(0), glm::vec3(0, 0, 1),
                     kTolerance);
  }
}

class GltfMorph : public GltfSkin {
 protected:
  // Targets that lift the second vertex by 1, and stretch the triangle along X by 2.
  Scene load_morphed(const std::string& attributes, const std::string& mesh, const std::string& node,
                     const std::string& normals = "") {
    const std::string position = number(builder_.vec3(kTriangle));
    const std::string lift = number(builder_.vec3({0, 0, 0, 0, 0, 1, 0, 0, 0}));
    const std::string stretch = number(builder_.vec3({0, 0, 0, 2, 0, 0, 0, 0, 0}));
    return folder_.load("a.gltf", builder_.text(R"("nodes":[{"mesh":0)" + node +
                                                R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" + position +
                                                attributes + R"(},"targets":[{"POSITION":)" + lift + normals +
                                                R"(},{"POSITION":)" + stretch + R"(},{}]}])" + mesh + "}]"));
  }
  static PosedVertices pose(const Scene& scene) {
    return pose_primitive(first_primitive(scene), take_snapshot(scene).instances.at(0));
  }
  std::string up() { return number(builder_.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1})); }
};

TEST_F(GltfMorph, WeightsAreTheNodesElseTheMeshesElseNone) {
  const auto second = [](const Scene& scene) { return pose(scene).positions.at(1); };
  const std::string mesh = R"(,"weights":[0.5,0.25,1])", node = R"(,"weights":[0,-1,0])";
  EXPECT_VEC3_NEAR(second(load_morphed("", "", "")), glm::vec3(2, 2, 0), kTolerance);
  EXPECT_VEC3_NEAR(second(load_morphed("", mesh, "")), glm::vec3(2.5f, 2, 0.5f), kTolerance);
  EXPECT_VEC3_NEAR(second(load_morphed("", mesh, node)), glm::vec3(0, 2, 0), kTolerance);
  EXPECT_VEC3_NEAR(second(load_morphed("", "", node)), glm::vec3(0, 2, 0), kTolerance);
}

TEST_F(GltfMorph, NormalsAreThoseOfTheFileWhereItHasAny) {
  const std::string given = R"(,"NORMAL":)" + up(), lifted = R"(,"weights":[1,0,0])";
  EXPECT_VEC3_NEAR(pose(load_morphed(given, lifted, "")).normals.at(1), glm::vec3(0, 0, 1), kTolerance);
  const std::string tilt = R"(,"NORMAL":)" + number(builder_.vec3({1, 0, 0, 1, 0, 0, 1, 0, 0}));
  const glm::vec3 half = glm::normalize(glm::vec3(1, 0, 1));
  EXPECT_VEC3_NEAR(pose(load_morphed(given, lifted, "", tilt)).normals.at(1), half, kTolerance);
}

// Without normals surfaces are flat, morphed ones too.
TEST_F(GltfMorph, FlatShapesStayFlat) {
  const glm::vec3 tilted = glm::normalize(glm::cross(glm::vec3(1, 0, 1), glm::vec3(0, 1, 0)));
  for (const char* weights : {R"(,"weights":[1,0,0])", R"(,"weights":[1,0,5])"})
    for (const glm::vec3& normal : pose(load_morphed("", weights, "")).normals)
      EXPECT_VEC3_NEAR(normal, tilted, kTolerance);
  for (const glm::vec3& normal : pose(load_morphed("", R"(,"weights":[0,1,0])", "")).normals)
    EXPECT_VEC3_NEAR(normal, glm::vec3(0, 0, 1), kTolerance);
}

TEST_F(GltfMorph, MorphsBeforeTheSkinMoves) {
  const std::string position = number(builder_.vec3(kTriangle));
  const std::string lift = number(builder_.vec3({0, 0, 4, 0, 0, 4, 0, 0, 4}));
  const float h = std::sqrt(0.5f);
  char rotation[64];
  std::snprintf(rotation, sizeof rotation, "[0,%.9g,0,%.9g]", static_cast<double>(h), static_cast<double>(h));
  const Scene scene = folder_.load(
      "a.gltf",
      builder_.text(
          R"("nodes":[{"mesh":0,"skin":0},{"rotation":)" + std::string(rotation) +
          R"(}],"skins":[{"joints":[1]}],"meshes":[{"weights":[0.5],"primitives":[{"attributes":{"POSITION":)" +
          position + skinned_to(bytes({0, 0, 0, 0}), floats({1, 0, 0, 0})) + R"(},"targets":[{"POSITION":)" + lift +
          "}]}]}]"));
  // A quarter turn about Y takes (1, 2, 0 + 2) to (2, 2, -1).
  EXPECT_VEC3_NEAR(first_vertex(scene), glm::vec3(2, 2, -1), kTolerance);
}

}  // namespace
}  // namespace lightwell
