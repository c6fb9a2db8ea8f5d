#include <gtest/gtest.h>

#include "lightwell/metrics.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

class Obj : public testing::Test {
 protected:
  Scene load(const std::string& text) { return folder_.load("a.obj", text); }
  std::string error(const std::string& text) { return folder_.error("a.obj", text); }
  // The first material of a library used by one triangle.
  Material material(const std::string& mtl) {
    folder_.write("m.mtl", mtl);
    return load("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n").materials.at(0);
  }
  TempFolder folder_;
};

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(Obj, NegativeIndicesCountBack) {
  const Scene positive = load(kSquare + "f 1 2 3\nv 0 0 5\nf 2 3 5\n");
  const Scene negative = load(kSquare + "f -4 -3 -2\nv 0 0 5\nf -4 -3 -1\n");
  EXPECT_EQ(first_primitive(positive).positions, first_primitive(negative).positions);
  EXPECT_EQ(triangle_count(negative), 2);
}

TEST_F(Obj, PolygonsAreFansOfTheSameArea) {
  const Scene quad = load(kSquare + "f 1 2 3 4\n");
  EXPECT_EQ(triangle_count(quad), 2);
  EXPECT_VEC3_NEAR(area_vector(first_primitive(quad)), glm::vec3(0, 0, 1), 1e-6f);
  const Scene hexagon = load("v 1 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5 6\n");
  EXPECT_EQ(triangle_count(hexagon), 4);
  EXPECT_VEC3_NEAR(area_vector(first_primitive(hexagon)), glm::vec3(0, 0, 4), 1e-6f);
}

TEST_F(Obj, BlanksCommentsAndContinuationsDoNotMatter) {
  const Scene plain = load(kSquare + "f 1 2 3 4\n");
  const Scene odd =
      load("# head\r\n\tv\t0  0 0 # comment 1 2 3\r\nv +1 0. 0e0 1.0\nv 1 1 \\\n 0\n\n  v 0 1 0\t\nf\t1 2 \\\r\n3 4");
  EXPECT_EQ(first_primitive(plain).positions, first_primitive(odd).positions);
  EXPECT_EQ(first_primitive(plain).indices, first_primitive(odd).indices);
}

TEST_F(Obj, FacesWithoutNormalsAreFlatOthersShareVertices) {
  const std::string roof = "v 0 1 0\nv 0 1 1\nv -1 0 0\nv 1 0 0\n";
  const Scene flat = load(roof + "f 1 3 2\nf 1 2 4\n");
  EXPECT_EQ(first_primitive(flat).positions.size(), 6u);
  EXPECT_LT(first_primitive(flat).normals[0].x, -0.7f);
  EXPECT_GT(first_primitive(flat).normals[3].x, 0.7f);
  const Scene smooth = load(roof + "vn 0 3 0\nf 1//1 3//1 2//1\nf 1//1 2//1 4//1\n");
  EXPECT_EQ(first_primitive(smooth).positions.size(), 4u);
  for (const glm::vec3& n : first_primitive(smooth).normals) EXPECT_VEC3_NEAR(n, glm::vec3(0, 1, 0), 1e-6f);
}

TEST_F(Obj, TextureCoordinatesPointDown) {
  const Scene scene = load(kSquare + "vt 0 0\nvt 1 0.25\nvt 0.5\nf 1/1 2/2 3/3\nf 1 2 3\n");
  const auto& uv = first_primitive(scene).texcoords[0];
  EXPECT_EQ(uv.at(0), glm::vec2(0, 1));
  EXPECT_EQ(uv.at(1), glm::vec2(1, 0.75f));
  EXPECT_EQ(uv.at(2), glm::vec2(0.5f, 1));
  EXPECT_EQ(uv.size(), first_primitive(scene).positions.size());
}

TEST_F(Obj, EachMaterialIsOnePrimitive) {
  folder_.write("a b.mtl", "newmtl red\nKd 1 0 0\nnewmtl lamp two\n\tKe 17 12 4 # watts\n  Kd 0.5\n");
  const Scene scene =
      load("mtllib a b.mtl\n" + kSquare + "usemtl red\nf 1 2 3\nusemtl lamp two\nf 1 3 4\nusemtl red\nf 1 2 4\n");
  ASSERT_EQ(scene.materials.size(), 2u);
  ASSERT_EQ(scene.meshes.at(0).primitives.size(), 2u);
  EXPECT_EQ(first_primitive(scene).indices.size(), 6u);
  EXPECT_EQ(scene.materials[0].base_color, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(scene.materials[1].base_color, glm::vec4(0.5f, 0.5f, 0.5f, 1));
  EXPECT_VEC3_NEAR(scene.materials[1].emission, glm::vec3(17, 12, 4), 0.0f);
  EXPECT_TRUE(scene.materials[1].double_sided);
}

TEST_F(Obj, SeveralLibrariesOnOneLine) {
  folder_.write("a.mtl", "newmtl a\n");
  folder_.write("b.mtl", "newmtl b\n");
  EXPECT_EQ(load("mtllib a.mtl b.mtl\nmtllib b.mtl\n" + kSquare + "f 1 2 3\n").materials.size(), 3u);
}

TEST_F(Obj, MissingLibraryAndMaterialAreSurvived) {
  const Scene scene = load("mtllib none.mtl\nusemtl ghost\n" + kSquare + "f 1 2 3\n");
  EXPECT_EQ(triangle_count(scene), 1);
  EXPECT_GE(first_primitive(scene).material, 0);
}

TEST_F(Obj, TexturesMultiplyColour) {
  Image white(1, 1);
  white.pixels = {1, 1, 1};
  save_png(folder_.path("t x.png"), white);
  const Material tinted = material("newmtl m\nKd 0.5 0.5 0.5\nmap_Kd -s 2 3 1 -o 0.5 0 -clamp on t x.png\n");
  EXPECT_EQ(tinted.base_color_texture.texture, 0);
  EXPECT_FLOAT_EQ(tinted.base_color.r, 0.5f);
  // The file's (0, 0) is our (0, 1): scaled and moved there it is (0.5, 0), ours (0.5, 1).
  const glm::vec2 corner = tinted.base_color_texture.transform * glm::vec3(0, 1, 1);
  EXPECT_VEC3_NEAR(glm::vec3(corner, 0), glm::vec3(0.5f, 1, 0), 1e-6f);
  const glm::vec2 opposite = tinted.base_color_texture.transform * glm::vec3(1, 0, 1);
  EXPECT_VEC3_NEAR(glm::vec3(opposite, 0), glm::vec3(2.5f, -2, 0), 1e-6f);
  EXPECT_FLOAT_EQ(material("newmtl m\nKd 0 0 0\nmap_Kd t x.png\n").base_color.r, 1.0f);
  EXPECT_EQ(material("newmtl m\nmap_Kd missing.png\n").base_color_texture.texture, -1);
}

TEST_F(Obj, FaultsAreNamedWithTheirLine) {
  EXPECT_NE(error(kSquare + "f 1 2 5\n").find("line 5: vertex 5 of 4"), std::string::npos);
  EXPECT_NE(error(kSquare + "f 1 2 -5\n").find("line 5"), std::string::npos);
  for (const char* face :
       {"f 0 1 2", "f 1 2", "f 1 2 x", "f 1/1 2 3", "f 1//1 2 3", "f 1/2/3/4 2 3", "f 1 2 99999999999999999999"})
    EXPECT_NE(error(kSquare + face), "") << face;
  for (const char* vertex : {"v 1 2", "v nan 0 0", "v inf 0 0", "v 1e39 0 0", "v 1 2 x", "vn 1 2", "vt"})
    EXPECT_NE(error(kSquare + "f 1 2 3\n" + vertex), "") << vertex;
  EXPECT_NE(error(kSquare).find("no faces"), std::string::npos);
  EXPECT_EQ(error(kSquare + "v 1e-60 0 0\nf 1 2 3\n"), "");
}

}  // namespace
}  // namespace lightwell
