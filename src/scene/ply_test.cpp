#include <algorithm>

#include <gtest/gtest.h>

#include "core/log.h"
#include "lightwell/metrics.h"
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

TEST_F(Ply, FarVerticesKeepTheirPrecision) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n";
  const Scene scene =
      load(header + kFaceHeader + "1000000.07 0 0\n1000001.07 0 0\n1000001.07 1 0\n1000000.07 1 0\n4 0 1 2 3\n");
  EXPECT_VEC3_NEAR(area_vector(first_primitive(scene)), glm::vec3(0, 0, 1), 1e-6f);
  EXPECT_NEAR(first_primitive(scene).positions[0].x + scene.nodes.at(0).translation.x, 1000000.07, 1e-6);
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

std::string ascii(const std::string& vertex_properties, const std::string& face_properties, int vertices, int faces,
                  const std::string& body, const std::string& comment = "") {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  return "ply\nformat ascii 1.0\n" + comment + "element vertex " + std::to_string(vertices) + "\n" + xyz +
         vertex_properties + "element face " + std::to_string(faces) + "\nproperty list uchar int vertex_indices\n" +
         face_properties + "end_header\n" + body;
}

TEST_F(Ply, ColoursOfVerticesAndFaces) {
  const std::string bytes = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const std::string floats = "property float red\nproperty float green\nproperty float blue\n";
  const WarningCapture capture;
  const std::vector<Scene> scenes = {
      load(ascii(bytes, "", 3, 1, "0 0 0 255 51 0\n1 0 0 255 51 0\n0 1 0 255 51 0\n3 0 1 2\n")),
      load(ascii(floats, "", 3, 1, "0 0 0 1 0.2 0\n1 0 0 1 0.2 0\n0 1 0 1 0.2 0\n3 0 1 2\n")),
      load(ascii("", bytes, 3, 1, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 51 0\n"))};
  for (const Scene& scene : scenes) {
    ASSERT_EQ(first_primitive(scene).colors.size(), 3u);
    for (const glm::vec4& color : first_primitive(scene).colors)
      EXPECT_VEC3_NEAR(glm::vec3(color), glm::vec3(1, srgb_decode(0.2f), 0), 1e-5f);
    EXPECT_EQ(scene.materials.at(0).base_color, glm::vec4(1));
  }
  EXPECT_EQ(capture.warnings().size(), 0u);
}

TEST_F(Ply, ColoursThatLetLightThrough) {
  const std::string rgba = "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
  const WarningCapture capture;
  const Scene scene = load(ascii(rgba, "", 3, 1, "0 0 0 1 1 1 255\n1 0 0 1 1 1 51\n0 1 0 1 1 1 0\n3 0 1 2\n"));
  EXPECT_NEAR(first_primitive(scene).colors[1].a, 0.2f, 1e-6f);
  EXPECT_EQ(scene.materials.at(0).alpha_mode, AlphaMode::kBlend);
  EXPECT_EQ(capture.warnings().size(), 1u);
}

TEST_F(Ply, TexturesOfFaces) {
  Image pixel(1, 1);
  save_png(folder_.path("a b.png"), pixel);
  save_png(folder_.path("c.png"), pixel);
  const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const WarningCapture capture;
  const Scene scene = load(ascii("", "property list uchar float texcoord\nproperty int texnumber\n", 4, 2,
                                 square + "3 0 1 2 6 0 0 1 0 1 0.75 1\n3 0 2 3 6 0 0 1 1 0 1 0\n",
                                 "comment TextureFile a b.png\ncomment TextureFile c.png\n"));
  EXPECT_EQ(capture.warnings().size(), 0u);
  ASSERT_EQ(scene.meshes.at(0).primitives.size(), 2u);
  const Primitive& second = scene.meshes[0].primitives[1];
  EXPECT_EQ(second.texcoords[0], (std::vector<glm::vec2>{{0, 1}, {1, 1}, {1, 0.25f}}));
  const Material& material = scene.materials.at(static_cast<std::size_t>(second.material));
  EXPECT_EQ(scene.textures.at(static_cast<std::size_t>(material.base_color_texture.texture)).name, "c.png");
  EXPECT_EQ(material.base_color, glm::vec4(1));
}

TEST_F(Ply, TextureOfVertices) {
  Image pixel(1, 1);
  save_png(folder_.path("t.png"), pixel);
  const std::string body = "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n";
  const std::string st = "property float s\nproperty float t\n";
  EXPECT_EQ(load(ascii(st, "", 3, 1, body, "comment TextureFile t.png\n")).materials.at(0).base_color_texture.texture,
            0);
  for (const char* name : {"none.png", "a.ply"}) {
    const WarningCapture capture;
    EXPECT_EQ(load(ascii(st, "", 3, 1, body, std::string("comment TextureFile ") + name + "\n")).textures.size(), 0u);
    EXPECT_EQ(capture.warnings().size(), 1u) << name;
  }
}

TEST_F(Ply, StripsOfTriangles) {
  const std::string square = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  const std::string head = "ply\nformat ascii 1.0\n" + kVertexHeader;
  const Scene scene = load(head + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" + square +
                           "9 0 1 2 3 -1 0 1 2 2\n");
  EXPECT_EQ(triangle_count(scene), 3);
  EXPECT_VEC3_NEAR(area_vector(first_primitive(scene)), glm::vec3(0, 0, 1.5f), 1e-6f);
}

TEST_F(Ply, ConcaveFaces) {
  const Scene scene = load(ascii("", "", 4, 1, "1 0.4 0\n2 0 0\n1 1.6 0\n0 0 0\n4 3 0 1 2\n"));
  EXPECT_VEC3_NEAR(area_vector(first_primitive(scene)), glm::vec3(0, 0, 1.2f), 1e-6f);
  for (std::size_t i = 0; i < 6; i += 3) {
    const auto& p = first_primitive(scene).positions;
    EXPECT_GT(glm::cross(p[i + 1] - p[i], p[i + 2] - p[i]).z, 0.0f);
  }
}

TEST_F(Ply, APointCloudIsNamed) {
  const std::string points =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n";
  for (const char* faces : {"", "element face 0\nproperty list uchar int vertex_indices\n"})
    EXPECT_NE(error(points + faces + "end_header\n0 0 0\n1 1 1\n").find("point cloud: 2 points"), std::string::npos);
}

TEST_F(Ply, LineEndsAndByteOrderMarks) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text = "\xef\xbb\xbf";
    for (const char c : kSquare) text += c == '\n' ? std::string(end) : std::string(1, c);
    EXPECT_EQ(triangle_count(load(text)), 2);
  }
}

TEST_F(Ply, BadFacesAndNumbersAreLeftOutWithAWarning) {
  for (const char* face : {"3 0 1 9", "3 0 1 -1", "3 0 1 0.5", "2 0 1", "3 0 1 4", "3 0 1 nan"}) {
    const WarningCapture capture;
    const Scene scene =
        load(ascii("", "", 5, 2, std::string("0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 nan 5\n4 0 1 2 3\n") + face + "\n"));
    EXPECT_EQ(triangle_count(scene), 2) << face;
    EXPECT_LE(take_snapshot(scene).bounds.maximum.x, 1.0f);
    ASSERT_EQ(capture.warnings().size(), 1u) << face;
    EXPECT_TRUE(capture.warnings()[0].starts_with(folder_.path("a.ply: face 1: "))) << capture.warnings()[0];
  }
  const WarningCapture capture;
  const Scene scene =
      load(ascii("property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float "
                 "t\nproperty float quality\n",
                 "", 3, 1, "0 0 0 nan 0 1 0 -nan(ind) 1\n1 0 0 0 0 1 0 0 1\n0 1 0 0 0 1 0 0 1\n3 0 1 2\n"));
  EXPECT_VEC3_NEAR(first_primitive(scene).normals[0], glm::vec3(0, 0, 1), 1e-6f);
  EXPECT_EQ(first_primitive(scene).texcoords[0][0], glm::vec2(0));
  EXPECT_EQ(capture.warnings().size(), 3u);  // the normal, the texture coordinate, "quality"
}

TEST_F(Ply, FaultsAreErrors) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kSquare;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(error(with("comment made by hand", "obj_info x")), "");
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
