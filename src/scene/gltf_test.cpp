// Everything of glTF files but geometry: containers, nodes, lights, cameras, materials, extensions.
#include <cmath>

#include <gtest/gtest.h>

#include "core/log.h"
#include "lightwell/metrics.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

std::string triangle(GltfBuilder& builder) {
  return R"("attributes":{"POSITION":)" + std::to_string(builder.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})) + "}";
}

class Gltf : public testing::Test {
 protected:
  Scene load(const std::string& rest, const ImportOptions& options = {}) {
    return folder_.load("a.gltf", gltf_of(rest), options);
  }
  std::string error(const std::string& rest) { return folder_.error("a.gltf", gltf_of(rest)); }
  // A picture of 2 x 1 texels, red and blue.
  void write_picture(const std::string& name) {
    Image image(2, 1);
    image.pixels = {1, 0, 0, 0, 0, 1};
    save_png(folder_.path(name), image);
  }

  TempFolder folder_;
};

TEST_F(Gltf, EmbeddedExternalAndBinaryFilesAreTheSameScene) {
  GltfBuilder builder;
  const std::string rest = R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{)" + triangle(builder) + "}]}]";
  folder_.write("my data.bin", builder.data());
  const Scene embedded = folder_.load("a.gltf", builder.text(rest));
  const Scene external = folder_.load("b.gltf", builder.text(rest, "my%20data.bin"));
  const Scene binary = folder_.load("c.glb", builder.glb(rest));
  for (const Scene* scene : {&external, &binary}) {
    EXPECT_EQ(first_primitive(*scene).positions, first_primitive(embedded).positions);
    EXPECT_EQ(first_primitive(*scene).indices, first_primitive(embedded).indices);
  }
  EXPECT_EQ(external.name, "b");
}

TEST_F(Gltf, NodesComeAfterTheirParents) {
  // The file lists grandchild, child, root.
  const Scene scene = load(R"("nodes":[{"name":"c","translation":[1,0,0],"camera":0},
      {"name":"b","children":[0],"rotation":[0,0.70710678,0,0.70710678]},
      {"name":"a","children":[1],"scale":[2,2,2]}],
      "cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}])");
  ASSERT_EQ(scene.nodes.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(scene.nodes[i].parent, static_cast<int>(i) - 1);
  EXPECT_EQ(scene.nodes[2].name, "c");
  // (1,0,0) turned a quarter about Y is (0,0,-1), then doubled.
  EXPECT_VEC3_NEAR(take_snapshot(scene).cameras.at(0).position, glm::vec3(0, 0, -2), 1e-5f);
}

TEST_F(Gltf, BadTreesAreErrors) {
  EXPECT_NE(error(R"("nodes":[{"children":[1]},{"children":[0]}])").find("cycle"), std::string::npos);
  EXPECT_NE(error(R"("nodes":[{"children":[0]}])").find("cycle"), std::string::npos);
  EXPECT_NE(error(R"("nodes":[{"children":[2]},{"children":[2]},{}])").find("two parents"), std::string::npos);
  EXPECT_NE(error(R"("nodes":[{"children":[7]}])"), "");
}

TEST_F(Gltf, OnlyTheDefaultSceneIsShown) {
  GltfBuilder builder;
  const std::string mesh = R"("meshes":[{"primitives":[{)" + triangle(builder) + R"(}]}],)";
  const Scene scene =
      folder_.load("a.gltf", builder.text(mesh + R"("nodes":[{"mesh":0},{"mesh":0,"translation":[5,0,0]}],
      "scenes":[{"nodes":[0]},{"nodes":[1]}],"scene":1)"));
  EXPECT_EQ(scene.nodes.size(), 2u);
  ASSERT_EQ(take_snapshot(scene).instances.size(), 1u);
  EXPECT_FLOAT_EQ(take_snapshot(scene).bounds.minimum.x, 5.0f);
}

TEST_F(Gltf, LightsShineAlongTheirNodes) {
  const Scene scene = load(R"("extensionsRequired":["KHR_lights_punctual"],
      "extensions":{"KHR_lights_punctual":{"lights":[
        {"type":"spot","color":[1,0.5,0.25],"intensity":8,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.4}},
        {"type":"directional","intensity":3},{"type":"point"}]}},
      "nodes":[{"rotation":[-0.70710678,0,0,0.70710678],"translation":[1,2,3],"extensions":{"KHR_lights_punctual":{"light":0}}},
        {"scale":[3,3,3],"extensions":{"KHR_lights_punctual":{"light":1}}},{"extensions":{"KHR_lights_punctual":{"light":2}}}])");
  const SceneSnapshot snapshot = take_snapshot(scene);
  ASSERT_EQ(snapshot.lights.size(), 3u);
  const WorldLight& spot = snapshot.lights[0];
  EXPECT_EQ(spot.type, LightType::kSpot);
  EXPECT_VEC3_NEAR(spot.position, glm::vec3(1, 2, 3), 1e-6f);
  EXPECT_VEC3_NEAR(spot.direction, glm::vec3(0, -1, 0), 1e-6f);
  EXPECT_VEC3_NEAR(spot.intensity, glm::vec3(8, 4, 2), 1e-6f);
  EXPECT_FLOAT_EQ(spot.cos_inner, std::cos(0.2f));
  EXPECT_FLOAT_EQ(spot.cos_outer, std::cos(0.4f));
  EXPECT_VEC3_NEAR(snapshot.lights[1].direction, glm::vec3(0, 0, -1), 1e-6f);
  EXPECT_VEC3_NEAR(snapshot.lights[1].intensity, glm::vec3(3), 1e-6f);
  EXPECT_EQ(snapshot.lights[2].type, LightType::kPoint);
}

TEST_F(Gltf, ScaleAndUpTurnTheWorldAndKeepIntensities) {
  GltfBuilder builder;
  const std::string rest = R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":8}]}},
      "nodes":[{"mesh":0,"children":[1]},{"translation":[0,0,100],"extensions":{"KHR_lights_punctual":{"light":0}}}],
      "skins":[{"joints":[1]}],"animations":[{"channels":[],"samplers":[]}],
      "meshes":[{"primitives":[{)" +
                           triangle(builder) + "}]}]";
  const Scene scene = folder_.load("a.gltf", builder.text(rest), {.scale = 0.01f, .up = 'z'});
  const SceneSnapshot snapshot = take_snapshot(scene);
  EXPECT_VEC3_NEAR(snapshot.lights.at(0).position, glm::vec3(0, 1, 0), 1e-6f);
  EXPECT_VEC3_NEAR(snapshot.lights.at(0).intensity, glm::vec3(8), 0.0f);
  EXPECT_VEC3_NEAR(snapshot.bounds.minimum, glm::vec3(0, 0, -0.01f), 1e-7f);
  EXPECT_VEC3_NEAR(snapshot.bounds.maximum, glm::vec3(0.01f, 0, 0), 1e-7f);
  EXPECT_EQ(scene.nodes[static_cast<std::size_t>(scene.skins.at(0).joints.at(0))].light, 0);
}

TEST_F(Gltf, CamerasOfBothKinds) {
  const Scene scene = load(R"("cameras":[{"type":"orthographic","orthographic":{"xmag":1,"ymag":2,"znear":0,"zfar":1}},
      {"name":"view","type":"perspective","perspective":{"yfov":0.5,"znear":0.1,"zfar":10}}],
      "nodes":[{"camera":0},{"camera":1,"translation":[0,1,0]}])");
  const SceneSnapshot snapshot = take_snapshot(scene);
  ASSERT_EQ(snapshot.cameras.size(), 2u);
  EXPECT_FLOAT_EQ(snapshot.cameras[0].half_height, 2.0f);
  EXPECT_EQ(snapshot.cameras[0].znear, 0.0f);
  EXPECT_EQ(snapshot.cameras[1].name, "view");
  EXPECT_EQ(snapshot.cameras[1].half_height, 0.0f);
  EXPECT_FLOAT_EQ(snapshot.cameras[1].yfov, 0.5f);
  EXPECT_VEC3_NEAR(snapshot.cameras[1].forward, glm::vec3(0, 0, -1), 1e-6f);
  EXPECT_VEC3_NEAR(snapshot.cameras[1].up, glm::vec3(0, 1, 0), 1e-6f);
}

TEST_F(Gltf, MaterialsAreRead) {
  const Scene scene = load(R"("materials":[{"name":"m","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],
      "metallicFactor":0.5,"roughnessFactor":0.6},"emissiveFactor":[1,0.5,0],"alphaMode":"MASK","alphaCutoff":0.7,
      "doubleSided":true,"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":10},
      "KHR_materials_ior":{"ior":1.3},"KHR_materials_specular":{"specularFactor":0.2,"specularColorFactor":[1,2,3]},
      "KHR_materials_transmission":{"transmissionFactor":1}}},{}])");
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_VEC3_NEAR(m.emission, glm::vec3(10, 5, 0), 1e-5f);
  EXPECT_EQ(m.alpha_mode, AlphaMode::kMask);
  EXPECT_FLOAT_EQ(m.alpha_cutoff, 0.7f);
  EXPECT_TRUE(m.double_sided);
  EXPECT_FLOAT_EQ(m.ior, 1.3f);
  EXPECT_FLOAT_EQ(m.specular, 0.2f);
  EXPECT_EQ(m.specular_color, glm::vec3(1, 2, 3));
  EXPECT_EQ(scene.materials.at(1).alpha_mode, AlphaMode::kOpaque);
}

TEST_F(Gltf, TexturesAreSharedBetweenUsesOfOneSampling) {
  write_picture("p.png");
  const Scene scene = load(R"("images":[{"uri":"p.png"}],"samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728}],
      "textures":[{"source":0,"sampler":0},{"source":0},{"source":0}],"materials":[
      {"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"emissiveTexture":{"index":1,"texCoord":1}},
      {"pbrMetallicRoughness":{"baseColorTexture":{"index":2}}}])");
  ASSERT_EQ(scene.textures.size(), 2u);
  const Texture& t = scene.textures[0];
  EXPECT_EQ(t.rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 255, 255}));
  EXPECT_EQ(t.wrap_u, Wrap::kClampToEdge);
  EXPECT_EQ(t.wrap_v, Wrap::kMirroredRepeat);
  EXPECT_TRUE(t.nearest);
  EXPECT_EQ(scene.materials[0].emission_texture.texture, 1);
  EXPECT_EQ(scene.materials[0].emission_texture.texcoord, 1);
  EXPECT_EQ(scene.materials[1].base_color_texture.texture, 1);
}

TEST_F(Gltf, TextureTransformScalesThenTurnsThenMoves) {
  write_picture("p.png");
  const auto apply = [&](const std::string& transform, glm::vec2 uv) {
    const Scene scene = load(R"("images":[{"uri":"p.png"}],"textures":[{"source":0}],"materials":[
        {"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{)" +
                             transform + "}}}}}]");
    return scene.materials.at(0).base_color_texture.transform * glm::vec3(uv, 1.0f);
  };
  const auto near = [](glm::vec2 a, glm::vec2 b) { return glm::length(a - b) < 1e-5f; };
  EXPECT_TRUE(near(apply(R"("offset":[3,4])", {0.25f, 0.5f}), {3.25f, 4.5f}));
  EXPECT_TRUE(near(apply(R"("scale":[2,3])", {0.25f, 0.5f}), {0.5f, 1.5f}));
  EXPECT_TRUE(near(apply(R"("rotation":1.5707963)", {0.25f, 0.5f}), {0.5f, -0.25f}));
  EXPECT_TRUE(near(apply(R"("offset":[1,1],"scale":[2,3],"rotation":1.5707963)", {0.25f, 0.5f}), {2.5f, 0.5f}));
}

TEST_F(Gltf, MissingTextureFilesAreDropped) {
  const Scene scene = load(R"("images":[{"uri":"nowhere.png"}],"textures":[{"source":0},{}],"materials":[
      {"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"emissiveTexture":{"index":1}}])");
  EXPECT_TRUE(scene.textures.empty());
  EXPECT_EQ(scene.materials[0].base_color_texture.texture, -1);
  EXPECT_EQ(scene.materials[0].emission_texture.texture, -1);
}

TEST_F(Gltf, TexturesWithoutCoordinatesAreNamed) {
  Image picture(2, 2);
  save_png(folder_.path("p.png"), picture);
  GltfBuilder b;
  const std::string position = std::to_string(b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  const std::string uv = std::to_string(b.vec2({0, 0, 1, 0, 0, 1}));
  const auto warnings = [&](const std::string& more, const std::string& set) {
    const WarningCapture capture;
    folder_.load("a.gltf", one_primitive(b, R"("material":0,"attributes":{"POSITION":)" + position + more + "}",
                                         R"(,"images":[{"uri":"p.png"}],"textures":[{"source":0}],"materials":
        [{"emissiveTexture":{"index":0,"texCoord":)" +
                                             set + "}}]"));
    return capture.warnings().size();
  };
  EXPECT_EQ(warnings(R"(,"TEXCOORD_0":)" + uv, "0"), 0u);
  EXPECT_EQ(warnings(R"(,"TEXCOORD_0":)" + uv, "1"), 1u);
  EXPECT_EQ(warnings("", "0"), 1u);
}

TEST_F(Gltf, UnknownRequiredExtensionsAreNamed) {
  EXPECT_NE(error(R"("extensionsRequired":["EXT_primitive_voxels"])").find("EXT_primitive_voxels"), std::string::npos);
  EXPECT_EQ(error(R"("extensionsUsed":["EXT_primitive_voxels"])"), "");
}

TEST_F(Gltf, AnimationsFollowReorderedNodes) {
  GltfBuilder builder;
  const std::string times = std::to_string(builder.floats("SCALAR", 1, {0, 1}));
  const std::string moves = std::to_string(builder.vec3({0, 0, 0, 1, 0, 0}));
  const std::string turns = std::to_string(builder.accessor(
      R"("bufferView":)" + std::to_string(builder.view(std::vector<std::int16_t>{0, 0, 0, 32767, 32767, 0, 0, 0})) +
      R"(,"componentType":5122,"normalized":true,"type":"VEC4","count":2)"));
  const Scene scene = folder_.load(
      "a.gltf",
      builder.text(R"("nodes":[{"name":"child"},{"name":"root","children":[0]}],"animations":[{"name":"go","channels":[
      {"sampler":0,"target":{"node":0,"path":"translation"}},{"sampler":1,"target":{"node":1,"path":"rotation"}},
      {"sampler":0,"target":{"node":1,"path":"pointer"}},{"sampler":0,"target":{"path":"scale"}}],"samplers":[
      {"input":)" + times +
                   R"(,"output":)" + moves + R"(,"interpolation":"STEP"},{"input":)" + times + R"(,"output":)" + turns +
                   "}]}]"));
  ASSERT_EQ(scene.animations.at(0).channels.size(), 2u);
  const AnimationChannel& move = scene.animations[0].channels[0];
  EXPECT_EQ(scene.nodes[static_cast<std::size_t>(move.node)].name, "child");
  EXPECT_EQ(move.interpolation, Interpolation::kStep);
  EXPECT_EQ(move.values, (std::vector<float>{0, 0, 0, 1, 0, 0}));
  const AnimationChannel& turn = scene.animations[0].channels[1];
  EXPECT_EQ(scene.nodes[static_cast<std::size_t>(turn.node)].name, "root");
  EXPECT_EQ(turn.values, (std::vector<float>{0, 0, 0, 1, 1, 0, 0, 0}));
  EXPECT_EQ(turn.interpolation, Interpolation::kLinear);
}

TEST_F(Gltf, MatricesReplaceTranslationRotationScale) {
  const Scene scene = load(R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},
      "nodes":[{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,4,5,6,1],"extensions":{"KHR_lights_punctual":{"light":0}}}])");
  EXPECT_VEC3_NEAR(take_snapshot(scene).lights.at(0).position, glm::vec3(4, 5, 6), 0.0f);
}

}  // namespace
}  // namespace lightwell
