// Geometry of glTF files: what is said in different ways comes out the same.
#include <cmath>

#include <gtest/gtest.h>

#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

// A unit square in the plane z = 0, seen counter-clockwise from +Z.
const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

std::string number(int value) {
  return std::to_string(value);
}

class GltfMesh : public testing::Test {
 protected:
  Scene load(const std::string& primitive) { return folder_.load("a.gltf", one_primitive(builder_, primitive)); }
  std::string error(const std::string& primitive) {
    return folder_.error("a.gltf", one_primitive(builder_, primitive));
  }

  TempFolder folder_;
  GltfBuilder builder_;
};

TEST_F(GltfMesh, ListStripAndFanCoverTheSameArea) {
  const std::string position = R"("attributes":{"POSITION":)" + number(builder_.vec3(kSquare)) + "}";
  const int list = builder_.indices({0, 1, 2, 2, 1, 3});
  const int strip = builder_.indices({0, 1, 2, 3});
  const int fan = builder_.indices({0, 1, 3, 2});
  for (const std::string& how : {R"(,"indices":)" + number(list), R"(,"mode":5,"indices":)" + number(strip),
                                 R"(,"mode":6,"indices":)" + number(fan), std::string(R"(,"mode":5)")}) {
    const Scene scene = load(position + how);
    EXPECT_EQ(triangle_count(scene), 2) << how;
    EXPECT_VEC3_NEAR(area_vector(first_primitive(scene)), glm::vec3(0, 0, 1), 1e-6f);
  }
}

TEST_F(GltfMesh, LongStripKeepsOrientation) {
  std::vector<float> zigzag;
  for (int i = 0; i < 9; ++i) zigzag.insert(zigzag.end(), {static_cast<float>(i / 2), static_cast<float>(i % 2), 0.0f});
  const Scene scene = load(R"("mode":5,"attributes":{"POSITION":)" + number(builder_.vec3(zigzag)) + "}");
  EXPECT_EQ(triangle_count(scene), 7);
  for (const glm::vec3& normal : first_primitive(scene).normals)
    EXPECT_VEC3_NEAR(normal, first_primitive(scene).normals.front(), 1e-6f);
}

TEST_F(GltfMesh, MissingNormalsAreFlatAndUnshared) {
  // A roof: two triangles that share an edge and meet at an angle.
  const int position = builder_.vec3({0, 1, 0, 0, 1, 1, -1, 0, 0, 1, 0, 0});
  const int uv = builder_.vec2({0, 0, 0, 1, 1, 0, 1, 1});
  const int index = builder_.indices({0, 2, 1, 0, 1, 3});
  const Scene scene = load(R"("attributes":{"POSITION":)" + number(position) + R"(,"TEXCOORD_0":)" + number(uv) +
                           R"(},"indices":)" + number(index));
  const Primitive& p = first_primitive(scene);
  ASSERT_EQ(p.positions.size(), 6u);
  ASSERT_EQ(p.texcoords[0].size(), 6u);
  const float s = std::sqrt(0.5f);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_VEC3_NEAR(p.normals[i], glm::vec3(-s, s, 0), 1e-6f);
    EXPECT_VEC3_NEAR(p.normals[3 + i], glm::vec3(s, s, 0), 1e-6f);
  }
  EXPECT_EQ(p.texcoords[0][5], glm::vec2(1, 1));
}

TEST_F(GltfMesh, NormalsBecomeUnitAndZeroOnesAreRepaired) {
  const int position = builder_.vec3(kSquare);
  const int normal = builder_.vec3({0, 0, 5, 0, 0, 0.1f, 0, 0, 0, 0, 0, 1});
  const int index = builder_.indices({0, 1, 2, 2, 1, 3});
  const Scene scene = load(R"("attributes":{"POSITION":)" + number(position) + R"(,"NORMAL":)" + number(normal) +
                           R"(},"indices":)" + number(index));
  ASSERT_EQ(first_primitive(scene).normals.size(), 4u);
  for (const glm::vec3& n : first_primitive(scene).normals) EXPECT_VEC3_NEAR(n, glm::vec3(0, 0, 1), 1e-6f);
}

TEST_F(GltfMesh, SparseValuesReplaceDenseOnesAndZeros) {
  const std::string view = number(builder_.view(kSquare));
  const std::string places = number(builder_.view(std::vector<std::uint16_t>{1, 3}));
  const std::string values = number(builder_.view(std::vector<float>{7, 0, 0, 8, 8, 0}));
  const std::string sparse =
      R"(,"componentType":5126,"type":"VEC3","count":4,"sparse":{"count":2,"indices":{"bufferView":)" + places +
      R"(,"componentType":5123},"values":{"bufferView":)" + values + "}}";
  const int on_data = builder_.accessor(R"("bufferView":)" + view + sparse);
  const int on_zeros = builder_.accessor(sparse.substr(1));
  const std::string strip_of = R"("mode":5,"attributes":{"POSITION":)";
  const Scene dense = load(strip_of + number(on_data) + "}");
  EXPECT_VEC3_NEAR(first_primitive(dense).positions[0], glm::vec3(0, 0, 0), 0.0f);
  EXPECT_VEC3_NEAR(first_primitive(dense).positions[1], glm::vec3(7, 0, 0), 0.0f);
  EXPECT_VEC3_NEAR(first_primitive(dense).positions[2], glm::vec3(0, 1, 0), 0.0f);
  const Scene zeros = load(strip_of + number(on_zeros) + "}");
  EXPECT_VEC3_NEAR(first_primitive(zeros).positions[1], glm::vec3(7, 0, 0), 0.0f);
  EXPECT_VEC3_NEAR(first_primitive(zeros).positions[2], glm::vec3(0, 0, 0), 0.0f);
}

TEST_F(GltfMesh, QuantisedPositionsEqualFloatOnes) {
  const std::vector<std::int16_t> words = {0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 16384, 0};  // stride 8
  const std::string view = number(builder_.view(words, R"(,"byteStride":8)"));
  const std::string fields = R"("bufferView":)" + view + R"(,"componentType":5122,"type":"VEC3","count":3)";
  const int normalized = builder_.accessor(fields + R"(,"normalized":true)");
  const int plain = builder_.accessor(fields);
  const Scene scene = load(R"("attributes":{"POSITION":)" + number(normalized) + "}");
  EXPECT_VEC3_NEAR(first_primitive(scene).positions[1], glm::vec3(1, 0, 0), 0.0f);
  EXPECT_VEC3_NEAR(first_primitive(scene).positions[2], glm::vec3(0, -1, 16384.0f / 32767.0f), 1e-7f);
  const Scene integers = load(R"("attributes":{"POSITION":)" + number(plain) + "}");
  EXPECT_VEC3_NEAR(first_primitive(integers).positions[2], glm::vec3(0, -32768, 16384), 0.0f);
}

TEST_F(GltfMesh, InterleavedAttributesAreToldApart) {
  std::vector<float> both;
  for (std::size_t v = 0; v < 4; ++v) {
    both.insert(both.end(), kSquare.begin() + static_cast<long>(3 * v), kSquare.begin() + static_cast<long>(3 * v + 3));
    both.insert(both.end(), {0, 0, 1});
  }
  const std::string view = number(builder_.view(both, R"(,"byteStride":24)"));
  const std::string fields = R"("bufferView":)" + view + R"(,"componentType":5126,"type":"VEC3","count":4)";
  const int position = builder_.accessor(fields);
  const int normal = builder_.accessor(fields + R"(,"byteOffset":12)");
  const Scene scene =
      load(R"("mode":5,"attributes":{"POSITION":)" + number(position) + R"(,"NORMAL":)" + number(normal) + "}");
  EXPECT_VEC3_NEAR(area_vector(first_primitive(scene)), glm::vec3(0, 0, 1), 1e-6f);
  for (const glm::vec3& n : first_primitive(scene).normals) EXPECT_VEC3_NEAR(n, glm::vec3(0, 0, 1), 0.0f);
}

TEST_F(GltfMesh, PointsAndLinesAreLeftOut) {
  const std::string position = R"("attributes":{"POSITION":)" + number(builder_.vec3(kSquare)) + "}";
  for (const char* mode : {"0", "1", "2", "3"})
    EXPECT_TRUE(load(position + R"(,"mode":)" + mode).meshes.at(0).primitives.empty());
  EXPECT_NE(error(position + R"(,"mode":7)"), "");
}

TEST_F(GltfMesh, MorphTargetsMoveTheRestPose) {
  const int position = builder_.vec3(kSquare);
  const int up = builder_.vec3({0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2});
  const std::string primitive =
      R"("mode":5,"attributes":{"POSITION":)" + number(position) + R"(},"targets":[{"POSITION":)" + number(up) + "}]";
  const auto load_with = [&](const std::string& mesh_weights, const std::string& node_weights) {
    const Scene scene = folder_.load(
        "a.gltf", builder_.text(R"("nodes":[{"mesh":0)" + node_weights + R"(}],"meshes":[{"primitives":[{)" +
                                primitive + "}]" + mesh_weights + "}]"));
    return take_snapshot(scene).bounds.maximum.z;
  };
  EXPECT_FLOAT_EQ(load_with("", ""), 0.0f);
  EXPECT_FLOAT_EQ(load_with(R"(,"weights":[0.5])", ""), 1.0f);
  EXPECT_FLOAT_EQ(load_with(R"(,"weights":[0.5])", R"(,"weights":[2])"), 4.0f);
}

TEST_F(GltfMesh, SkinnedMeshAtRestFollowsItsJoints) {
  // The joint stands at (0, 3, 0) and was bound there; the mesh's own node has a transform that does not count.
  const int position = builder_.vec3(kSquare);
  const int joints = builder_.accessor(R"("bufferView":)" + number(builder_.view(std::vector<std::uint8_t>(16, 0))) +
                                       R"(,"componentType":5121,"type":"VEC4","count":4)");
  const int weights = builder_.floats("VEC4", 4, {2, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0});
  const int bind = builder_.floats("MAT4", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -2, 0, 1});
  const Scene scene = folder_.load(
      "a.gltf", builder_.text(R"("nodes":[{"mesh":0,"skin":0,"translation":[9,9,9]},{"translation":[0,3,0]}],
      "skins":[{"joints":[1],"inverseBindMatrices":)" +
                              number(bind) + R"(}],"meshes":[{"primitives":[{"mode":5,"attributes":{"POSITION":)" +
                              number(position) + R"(,"JOINTS_0":)" + number(joints) + R"(,"WEIGHTS_0":)" +
                              number(weights) + "}}]}]"));
  for (const glm::vec4& w : first_primitive(scene).weights) EXPECT_FLOAT_EQ(w.x + w.y + w.z + w.w, 1.0f);
  const SceneSnapshot snapshot = take_snapshot(scene);
  EXPECT_VEC3_NEAR(snapshot.bounds.minimum, glm::vec3(0, 1, 0), 1e-6f);
  EXPECT_VEC3_NEAR(snapshot.bounds.maximum, glm::vec3(1, 2, 0), 1e-6f);
  EXPECT_VEC3_NEAR(glm::vec3(snapshot.instances.at(0).joints.at(0)[3]), glm::vec3(0, 1, 0), 1e-6f);
}

TEST_F(GltfMesh, DegenerateTrianglesAreKept) {
  const int position = builder_.vec3({0, 0, 0, 1, 0, 0, 2, 0, 0});
  const Scene scene = load(R"("attributes":{"POSITION":)" + number(position) + "}");
  EXPECT_EQ(triangle_count(scene), 1);
  EXPECT_FLOAT_EQ(glm::length(first_primitive(scene).normals[0]), 1.0f);
}

}  // namespace
}  // namespace lightwell
