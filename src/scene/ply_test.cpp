#include <algorithm>

#include <gtest/gtest.h>

#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

// Bytes of a number, in either order.
template <typename T>
std::string bytes_of(T value, bool big_endian) {
  std::string bytes = raw_bytes(std::vector<T>{value});
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

class Ply : public testing::Test {
 protected:
  Scene load(const std::string& text) { return folder_.load("a.ply", text); }
  std::string error(const std::string& text) { return folder_.error("a.ply", text); }
  TempFolder folder_;
};

const std::string kVertexHeader = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaceHeader = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kSquare = "ply\nformat ascii 1.0\ncomment made by hand\n" + kVertexHeader + kFaceHeader +
                            "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

TEST_F(Ply, QuadsBecomeFlatTriangles) {
  const Scene scene = load(kSquare);
  EXPECT_EQ(triangle_count(scene), 2);
  EXPECT_VEC3_NEAR(area_vector(first_primitive(scene)), glm::vec3(0, 0, 1), 1e-6f);
  for (const glm::vec3& n : first_primitive(scene).normals) EXPECT_VEC3_NEAR(n, glm::vec3(0, 0, 1), 1e-6f);
}

TEST_F(Ply, BinaryOfEitherOrderIsTheSameMesh) {
  for (const bool big : {false, true}) {
    std::string text = "ply\nformat binary_" + std::string(big ? "big" : "little") + "_endian 1.0\r\n" +
                       "element vertex 4\nproperty double x\nproperty float y\nproperty short z\nproperty uchar red\n" +
                       "element face 1\nproperty list ushort uint vertex_index\nend_header\n";
    for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
      text += bytes_of(double(x), big) + bytes_of(float(y), big) + bytes_of(std::int16_t{-3}, big) + "r";
    text += bytes_of(std::uint16_t{4}, big);
    for (const std::uint32_t i : {0u, 1u, 2u, 3u}) text += bytes_of(i, big);
    const Scene scene = load(text);
    EXPECT_VEC3_NEAR(area_vector(first_primitive(scene)), glm::vec3(0, 0, 1), 1e-6f);
    EXPECT_FLOAT_EQ(first_primitive(scene).positions[0].z, -3.0f);
  }
}

TEST_F(Ply, NormalsAndTextureCoordinatesAreKeptOthersSkipped) {
  const Scene scene = load(
      "ply\nformat ascii 1.0\nelement camera 1\nproperty list int float junk\nproperty int n\n"
      "element vertex 3\nproperty uchar red\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "property float x\nproperty float y\nproperty float z\nproperty list uchar int more\n"
      "property float s\nproperty float t\n"
      "element face 1\nproperty uchar flag\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nelement edge 0\nproperty int a\nend_header\n"
      "2 0.5 0.5 7\n255 0 2 0  0 0 0  2 8 8  0 0\n255 0 1 0  1 0 0  0  1 0\n255 0 1 0  0 0 1  0  0 1\n"
      "9 3 2 1 0 1 0.5\n");
  const Primitive& p = first_primitive(scene);
  EXPECT_EQ(p.indices, (std::vector<std::uint32_t>{2, 1, 0}));
  for (const glm::vec3& n : p.normals) EXPECT_VEC3_NEAR(n, glm::vec3(0, 1, 0), 1e-6f);
  EXPECT_EQ(p.texcoords[0].at(1), glm::vec2(1, 1));
  EXPECT_EQ(p.texcoords[0].at(2), glm::vec2(0, 0));
}

TEST_F(Ply, FaultsAreErrors) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kSquare;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(error(with("comment made by hand", "obj_info x")), "");
  EXPECT_NE(error(with("4 0 1 2 3", "4 0 1 2 4")).find("vertex 4 of 4"), std::string::npos);
  EXPECT_NE(error(with("vertex 4", "vertex 4000000000")).find("truncated"), std::string::npos);
  for (const auto& [from, to] : {std::pair("4 0 1 2 3", "4 0 1 2 -1"),
                                 {"4 0 1 2 3", "4 0 1 2 0.5"},
                                 {"4 0 1 2 3", "9 0 1 2 3"},
                                 {"4 0 1 2 3", "2 0 1"},
                                 {"face 1", "face 2"},
                                 {"vertex 4", "vertex -4"},
                                 {"float x", "float w"},
                                 {"float x", "half x"},
                                 {"ascii", "utf8"},
                                 {"end_header", ""},
                                 {"1 1 0", "1 nan 0"},
                                 {"element vertex 4\n", ""},
                                 {"ply", "PLY"}})
    EXPECT_NE(error(with(from, to)), "") << from << " -> " << to;
}

}  // namespace
}  // namespace lightwell
