#include <gtest/gtest.h>

#include "core/log.h"
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

// Coordinates of a map keep their centimetres: the node has the distance. Where one vertex is near 0, all are what they
// are.
TEST_F(Obj, FarVerticesKeepTheirPrecision) {
  const std::string far = "v 500000.12 5400000.25 -1000000.07\nv 500001.12 5400000.25 -1000000.07\n";
  const Scene scene = load(far + "v 500000.12 5400001.25 -1000000.07\nf 1 2 3\n");
  EXPECT_VEC3_NEAR(first_primitive(scene).positions[1] - first_primitive(scene).positions[0], glm::vec3(1, 0, 0),
                   1e-6f);
  const glm::dvec3 first = glm::dvec3(first_primitive(scene).positions[0]) + scene.nodes.at(0).translation;
  EXPECT_LT(glm::length(first - glm::dvec3(500000.12, 5400000.25, -1000000.07)), 1e-5);
  const Scene near = load(far + "v 0.001 0 0\nf 1 2 3\n");
  EXPECT_EQ(first_primitive(near).positions[2], glm::vec3(0.001f, 0, 0));
  EXPECT_EQ(near.nodes.at(0).translation, glm::dvec3(0.0));
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

// A bad line costs what it says and no more, and is named.
TEST_F(Obj, FaultsAreLeftOutWithAWarningOfTheirLine) {
  for (const char* line : {"f 0 1 2",
                           "f 1 2",
                           "f 1 2 x",
                           "f 1//x 2 3",
                           "f 1/2/3/4 2 3",
                           "f 1 2 99999999999999999999",
                           "f 1 2 5",
                           "f 1 2 -5",
                           "f 1/1 2 3",
                           "f 1//1 2 3",
                           "v 1 2",
                           "v nan 0 0",
                           "v inf 0 0",
                           "v 1e39 0 0",
                           "v 1 2 x",
                           "vn 1 2",
                           "vt",
                           "vt x",
                           "vn nan 0 0",
                           "vt -nan(ind) 0",
                           "v 1.#IND 0 0",
                           "unheard of",
                           "l 1 2",
                           "curv 0 1"}) {
    const WarningCapture capture;
    const Scene scene = load(kSquare + "f 1 2 3 4\n" + line + "\n");
    EXPECT_GE(triangle_count(scene), 2) << line;
    ASSERT_EQ(capture.warnings().size(), 1u) << line;
    EXPECT_TRUE(capture.warnings()[0].starts_with(folder_.path("a.obj: line 6: "))) << capture.warnings()[0];
  }
  for (const char* line : {"f 1/0 2/0 3/0", "f 1//0 2 3", "v 1e-60 0 0", "vt 0.5", "s off", "g a b", "", "v 1 2 3 1"}) {
    const WarningCapture capture;
    load(kSquare + "f 1 2 3 4\n" + line + "\n");
    EXPECT_EQ(capture.warnings().size(), 0u) << line << ": " << capture.warnings()[0];
  }
  EXPECT_NE(error(kSquare).find("no faces"), std::string::npos);
  EXPECT_NE(error("v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").find("no faces"), std::string::npos);
}

// Each kind of fault is one line, however often it occurs.
TEST_F(Obj, ManyFaultsAreOneWarning) {
  const WarningCapture capture;
  std::string text = kSquare + "f 1 2 3 4\n";
  for (int i = 0; i < 100; ++i) text += "f 1 2 99\n";
  load(text);
  ASSERT_EQ(capture.warnings().size(), 1u);
  EXPECT_NE(capture.warnings()[0].find("line 6: "), std::string::npos) << capture.warnings()[0];
  EXPECT_TRUE(capture.warnings()[0].ends_with(" (100 times)")) << capture.warnings()[0];
}

TEST_F(Obj, ByteOrderMarksAndLineEndsOfAnyProgram) {
  const std::string mark = "\xef\xbb\xbf";
  folder_.write("m.mtl", mark + "newmtl red\rKd 1 0 0\rnewmtl blue\rKd 0 0 1\r");
  const std::string head = "mtllib m.mtl\nusemtl red\n";
  for (const std::string& text : {mark + head + kSquare + "f 1 2 3 4\n", mark + kSquare + head + "f 1 2 3 4\n",
                                  head + mark + kSquare + mark + "f 1 2 3 4"}) {
    for (const char* end : {"\n", "\r\n", "\r"}) {
      std::string ended;
      for (const char c : text) ended += c == '\n' ? std::string(end) : std::string(1, c);
      const WarningCapture capture;
      const Scene scene = load(ended);
      EXPECT_EQ(triangle_count(scene), 2);
      EXPECT_EQ(scene.materials.at(static_cast<std::size_t>(first_primitive(scene).material)).base_color,
                glm::vec4(1, 0, 0, 1));
      EXPECT_EQ(capture.warnings().size(), 0u);
    }
  }
}

TEST_F(Obj, CommentsDoNotGoOnInTheNextLine) {
  EXPECT_EQ(triangle_count(load(kSquare + "# C:\\models\\\nf 1 2 3 4\n")), 2);
  EXPECT_EQ(triangle_count(load(kSquare + "g a # b \\\nf 1 2 3 4\n")), 2);
}

TEST_F(Obj, NamesMayHoldNumberSigns) {
  Image pixel(1, 1);
  save_png(folder_.path("wood #2.png"), pixel);
  folder_.write("lib #1.mtl", "newmtl wood #2\nKd 1 0 0\nmap_Kd wood #2.png\nnewmtl plain # of no colour\nKd 0 1 0\n");
  const WarningCapture capture;
  const Scene scene =
      load("mtllib lib #1.mtl\n" + kSquare +
           "vt 0 0\nusemtl wood #2\nf 1/1 2/1 3/1\nusemtl plain # again\nf 1 3 4\nusemtl plain\nf 1 2 4\n");
  EXPECT_EQ(capture.warnings().size(), 0u);
  ASSERT_EQ(scene.meshes.at(0).primitives.size(), 2u);
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.materials.at(0).base_color_texture.texture, 0);
  EXPECT_EQ(triangle_count(scene), 3);
}

TEST_F(Obj, VertexColours) {
  const Scene scene = load("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0.5 0.5 0.5\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  const Primitive& p = first_primitive(scene);
  ASSERT_EQ(p.colors.size(), p.positions.size());
  EXPECT_EQ(p.colors[0], glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(p.colors[1], glm::vec4(0, 1, 0, 1));
  EXPECT_NEAR(p.colors[2].g, srgb_decode(0.5f), 1e-6f);
  EXPECT_EQ(p.colors[4], glm::vec4(1));
  EXPECT_EQ(scene.materials.at(0).base_color, glm::vec4(1));
  const WarningCapture capture;
  const Scene bytes = load("v 0 0 0 255 0 0\nv 1 0 0 0 51 0\nv 0 1 0 0 0 255\nf 1 2 3\n");
  EXPECT_NEAR(first_primitive(bytes).colors[1].g, srgb_decode(0.2f), 1e-6f);
  EXPECT_EQ(capture.warnings().size(), 1u);
}

TEST_F(Obj, ConcavePolygonsKeepTheirArea) {
  // An arrow head of area 1.2 whose fan about the first corner would fill the notch.
  const Scene scene = load("v 1 0.4 0\nv 2 0 0\nv 1 1.6 0\nv 0 0 0\nf 4 1 2 3\nf 1 2 3 4\n");
  float size = 0.0f;
  const Primitive& p = first_primitive(scene);
  for (std::size_t i = 0; i < p.indices.size(); i += 3)
    size += 0.5f * glm::length(glm::cross(p.positions[p.indices[i + 1]] - p.positions[p.indices[i]],
                                          p.positions[p.indices[i + 2]] - p.positions[p.indices[i]]));
  EXPECT_NEAR(size, 2.4f, 1e-5f);
}

TEST_F(Obj, OpacityIsShownAsItCanBe) {
  for (const char* statement : {"d 0.1", "Tr 0.9", "d -halo 0.1", "Tr 0.3\nd 0.1"}) {
    const WarningCapture capture;
    const Material glass = material(std::string("newmtl m\nKd 1 1 1\n") + statement + "\n");
    EXPECT_EQ(glass.alpha_mode, AlphaMode::kBlend) << statement;
    EXPECT_NEAR(glass.base_color.a, 0.1f, 1e-6f) << statement;
    EXPECT_GE(capture.warnings().size(), 1u);
  }
  const WarningCapture capture;
  EXPECT_EQ(material("newmtl m\nd 1\nTr 0\n").alpha_mode, AlphaMode::kOpaque);
  EXPECT_EQ(capture.warnings().size(), 0u);
}

// Two texels wide: left bright, right dark.
Image left_half() {
  Image image(2, 1);
  image.pixels = {1, 1, 1, 0, 0, 0};
  return image;
}

TEST_F(Obj, OpacityMapsAreMasks) {
  save_png(folder_.path("mask.png"), left_half());
  Image red(4, 2);
  for (std::size_t i = 0; i < red.pixels.size(); i += 3) red.pixels[i] = 1.0f;
  save_png(folder_.path("red.png"), red);
  const WarningCapture capture;
  folder_.write("m.mtl", "newmtl m\nmap_Kd red.png\nmap_d -imfchan l mask.png\nnewmtl n\nmap_d mask.png\n");
  const Scene scene = load("mtllib m.mtl\nvt 0 0\n" + kSquare + "usemtl m\nf 1/1 2/1 3/1\nusemtl n\nf 1/1 3/1 4/1\n");
  EXPECT_EQ(capture.warnings().size(), 0u);
  for (std::size_t m = 0; m < 2; ++m) {
    const Material& material = scene.materials.at(m);
    EXPECT_EQ(material.alpha_mode, AlphaMode::kMask);
    const Texture& texture = scene.textures.at(static_cast<std::size_t>(material.base_color_texture.texture));
    const std::size_t last = texture.rgba.size() - 4;
    EXPECT_EQ(texture.rgba[0], 255);
    EXPECT_EQ(texture.rgba[1], m == 0 ? 0 : 255);
    EXPECT_EQ(texture.rgba[3], 255);
    EXPECT_EQ(texture.rgba[last], 255);
    EXPECT_EQ(texture.rgba[last + 3], 0);
    EXPECT_EQ(texture.width, m == 0 ? 4 : 2);
  }
}

TEST_F(Obj, MapsOfSurfacesToComeAreKeptAndNamed) {
  save_png(folder_.path("t.png"), left_half());
  const WarningCapture capture;
  const Material m = material(
      "newmtl m\nPr 0.25\nPm 0.5\nmap_Bump -bm 0.3 t.png\nnorm -clamp on t.png\nmap_Ks t.png\nPc 1\nKs 0 0 0\nTf 1 1 "
      "1\n");
  EXPECT_EQ(m.roughness, 0.25f);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_GE(m.bump_texture.texture, 0);
  EXPECT_FLOAT_EQ(m.bump_scale, 0.3f);
  EXPECT_GE(m.normal_texture.texture, 0);
  EXPECT_EQ(capture.warnings().size(), 4u);  // bump, normal, map_Ks, Pc
}

TEST_F(Obj, WhatLambertSurfacesLackIsNamedOnce) {
  const auto warnings = [&](const std::string& statements) {
    const WarningCapture capture;
    material("newmtl m\n" + statements + "newmtl n\n" + statements);
    return capture.warnings().size();
  };
  EXPECT_EQ(warnings("Ka 1 1 1\nNs 250\nKs 0 0 0\nillum 2\nPcr 0.03\nanisor 0.5\n"), 0u);
  EXPECT_EQ(warnings("Ks 0.5 0.5 0.5\n"), 1u);
  EXPECT_EQ(warnings("illum 7\n"), 1u);
}

TEST_F(Obj, TexturedFacesWithoutCoordinatesAreNamed) {
  save_png(folder_.path("t.png"), left_half());
  folder_.write("m.mtl", "newmtl m\nmap_Kd t.png\n");
  const auto warnings = [&](const std::string& faces) {
    const WarningCapture capture;
    folder_.load("a.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n" + faces);
    return capture.warnings().size();
  };
  EXPECT_EQ(warnings("usemtl m\nf 1/1 2/1 3/1\n"), 0u);
  EXPECT_EQ(warnings("f 1 2 3\nusemtl m\nf 1/1 2/1 3/1\n"), 0u);
  EXPECT_EQ(warnings("usemtl m\nf 1/1 2/1 3/1\nf 1 2 3\n"), 1u);
}

TEST_F(Obj, MalformedLibrariesAreReadAsFarAsTheyGo) {
  const WarningCapture capture;
  const Material m = material("Kd 1 1 1\nnewmtl m\nKd red\nNi\nd nan\nKe -1 2 3\nmap_Kd\nKd 0.5 0.25 0\n");
  EXPECT_EQ(m.base_color, glm::vec4(0.5f, 0.25f, 0, 1));
  EXPECT_EQ(m.emission, glm::vec3(0, 2, 3));
  EXPECT_EQ(capture.warnings().size(), 6u);
}

}  // namespace
}  // namespace lightwell
