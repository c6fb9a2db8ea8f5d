// glTF files that are almost right: the scene is shown, with a warning that names the place.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/log.h"
#include "scene/pose.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Loaded {
  Scene scene;
  std::vector<std::string> warnings;
};

class GltfRepair : public testing::Test {
 protected:
  Loaded load_text(const std::string& text) {
    const WarningCapture capture;
    Scene scene = folder_.load("a.gltf", text);
    return {std::move(scene), capture.warnings()};
  }
  // With one warning, which begins with the file's name and the place.
  Scene mended_text(const std::string& text, const std::string& place) {
    Loaded loaded = load_text(text);
    EXPECT_EQ(loaded.warnings.size(), 1u) << place;
    for (const std::string& warning : loaded.warnings)
      EXPECT_TRUE(warning.starts_with(folder_.path("a.gltf: " + place + ": "))) << warning;
    return std::move(loaded.scene);
  }
  Scene mended(const std::string& rest, const std::string& place) { return mended_text(gltf_of(rest), place); }

  Node mended_node(const std::string& member, const std::string& place) {
    return mended(R"("nodes":[{},{)" + member + "}]", "nodes[1]." + place).nodes.at(1);
  }
  Light mended_light(const std::string& members, const std::string& place = "") {
    return mended(R"("extensions":{"KHR_lights_punctual":{"lights":[{)" + members + "}]}}",
                  "extensions.KHR_lights_punctual.lights[0]" + place)
        .lights.at(0);
  }
  Camera mended_camera(const std::string& kind, const std::string& members, const std::string& place) {
    return mended(R"("cameras":[{"type":")" + kind + R"(",")" + kind + "\":{" + members + "}}]",
                  "cameras[0]." + kind + "." + place)
        .cameras.at(0);
  }
  Material mended_material(const std::string& members, const std::string& place) {
    return mended(R"("materials":[{)" + members + "}]", "materials[0]." + place).materials.at(0);
  }

  // A primitive of two triangles; `attribute` is a fourth one's name and accessor.
  std::string quad(GltfBuilder& builder, const std::string& name, int accessor, const std::string& more = "") {
    const int position = builder.vec3({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    const int normal = builder.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    const int indices = builder.indices({0, 1, 2, 0, 2, 3});
    const auto entry = [&](const std::string& key, int value) {
      const int used = key == name ? accessor : value;
      return "\"" + key + "\":" + std::to_string(used);
    };
    std::string attributes = entry("POSITION", position) + "," + entry("NORMAL", normal);
    if (name != "POSITION" && name != "NORMAL") attributes += "," + entry(name, accessor);
    return one_primitive(builder, "\"attributes\":{" + attributes + "},\"indices\":" + std::to_string(indices) + more);
  }
  Primitive mended_attribute(GltfBuilder& builder, const std::string& name, int accessor) {
    const Scene scene = mended_text(quad(builder, name, accessor), "meshes[0].primitives[0].attributes." + name);
    return scene.meshes.at(0).primitives.at(0);
  }

  TempFolder folder_;
};

TEST_F(GltfRepair, MatricesThatAreNotQuiteAffine) {
  for (const char* last : {"0.99999994", "1.0000001", "0"}) {
    const Node node = mended_node(R"("matrix":[2,0,0,0,0,1,0,0,0,0,1,0,4,5,6,)" + std::string(last) + "]", "matrix");
    EXPECT_EQ((*node.matrix)[3], glm::dvec4(4, 5, 6, 1));
    EXPECT_EQ((*node.matrix)[0].x, 2.0);
  }
  // A factor of the whole matrix divides it.
  EXPECT_EQ((*mended_node(R"("matrix":[2,0,0,0,0,2,0,0,0,0,2,0,8,10,12,2])", "matrix").matrix)[3],
            glm::dvec4(4, 5, 6, 1));
  EXPECT_EQ((*mended_node(R"("matrix":[1,0,0,1e-7,0,1,0,0,0,0,1,0,4,5,6,1])", "matrix").matrix)[0],
            glm::dvec4(1, 0, 0, 0));
  for (const char* damaged : {"[1]", "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1e60]", R"("x")"})
    EXPECT_EQ(*mended_node(R"("matrix":)" + std::string(damaged), "matrix").matrix, glm::dmat4(1.0));
}

TEST_F(GltfRepair, Rotations) {
  for (const char* none : {"[0,0,0,0]", "[1e-30,0,0,0]", "[0,0,0]", "[0,0,0,1e99]", "[null,null,null,null]", "null"})
    EXPECT_EQ(mended_node(R"("rotation":)" + std::string(none), "rotation").rotation, glm::quat(1, 0, 0, 0)) << none;
  for (const char* longer : {"[0,3,0,3]", "[0,1e-3,0,1e-3]", "[0,1e30,0,1e30]"}) {
    const glm::quat q = mended_node(R"("rotation":)" + std::string(longer), "rotation").rotation;
    EXPECT_NEAR(q.y, std::sqrt(0.5f), 1e-6f);
    EXPECT_NEAR(q.w, std::sqrt(0.5f), 1e-6f);
  }
  // What rounding leaves is no fault.
  EXPECT_TRUE(load_text(gltf_of(R"("nodes":[{"rotation":[0,0.7071,0,0.7071]}])")).warnings.empty());
}

TEST_F(GltfRepair, TranslationsScalesAndNames) {
  EXPECT_EQ(mended_node(R"("translation":[1,2])", "translation").translation, glm::dvec3(0.0));
  EXPECT_EQ(mended_node(R"("translation":[1,2,1e39])", "translation").translation, glm::dvec3(0.0));
  EXPECT_EQ(mended_node(R"("scale":[1,null,1])", "scale").scale, glm::vec3(1.0f));
  for (const char* name : {"null", "5", R"(["a"])"})
    EXPECT_EQ(mended_node(R"("name":)" + std::string(name), "name").name, "");
  EXPECT_EQ(mended(R"("materials":[{"name":null}])", "materials[0].name").materials.at(0).name, "");
  EXPECT_EQ(mended(R"("meshes":[{"name":{}}])", "meshes[0].name").meshes.at(0).name, "");
  EXPECT_EQ(
      mended(R"("cameras":[{"name":false,"perspective":{"yfov":1,"znear":1}}])", "cameras[0].name").cameras.at(0).name,
      "");
}

TEST_F(GltfRepair, AThousandFaultsOfAKindAreOneWarning) {
  std::string nodes = "{}";
  for (int i = 0; i < 1000; ++i) nodes += R"(,{"rotation":[0,0,0,0]})";
  const Loaded loaded = load_text(gltf_of("\"nodes\":[" + nodes + "]"));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("nodes[1].rotation"), std::string::npos);
  EXPECT_NE(loaded.warnings[0].find("(1000 times)"), std::string::npos);
}

TEST_F(GltfRepair, SpotAngles) {
  const auto spot = [&](const std::string& cone, const std::string& place) {
    return mended_light(R"("type":"spot","spot":{)" + cone + "}", place);
  };
  for (const char* cone : {R"("innerConeAngle":0.6,"outerConeAngle":0.6)", R"("innerConeAngle":0.8)",
                           R"("innerConeAngle":0.7,"outerConeAngle":0.2)", R"("innerConeAngle":0,"outerConeAngle":0)",
                           R"("innerConeAngle":1.5707964,"outerConeAngle":1.5707964)"}) {
    const Light light = spot(cone, ".spot");
    EXPECT_LT(light.inner_angle, light.outer_angle) << cone;
    EXPECT_LT(light.outer_angle - light.inner_angle, 0.01f) << cone;
    EXPECT_LT(std::cos(light.outer_angle), std::cos(light.inner_angle)) << cone;
  }
  EXPECT_EQ(spot(R"("innerConeAngle":-0.1)", ".spot.innerConeAngle").inner_angle, 0.0f);
  EXPECT_NEAR(spot(R"("outerConeAngle":3)", ".spot.outerConeAngle").outer_angle, 1.5707964f, 1e-6f);
}

TEST_F(GltfRepair, Lights) {
  EXPECT_EQ(mended_light(R"("type":"point","intensity":-5)", ".intensity").intensity, glm::vec3(0.0f));
  EXPECT_EQ(mended_light(R"("type":"point","color":[-1,0.5,0.25])", ".color").intensity, glm::vec3(0, 0.5f, 0.25f));
  EXPECT_EQ(mended_light(R"("type":"point","intensity":1e99)", ".intensity").intensity, glm::vec3(1.0f));
  EXPECT_EQ(mended_light(R"("type":"point","range":0)", ".range").range, kInfinity);
  EXPECT_EQ(mended_light(R"("type":"point","range":-2)", ".range").range, 0.0f + kInfinity);
  const Loaded other = load_text(gltf_of(
      R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"area"},{"type":"point","range":3}]}},
      "nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}},{"extensions":{"KHR_lights_punctual":{"light":1}}}])"));
  EXPECT_EQ(other.warnings.size(), 1u);
  ASSERT_EQ(take_snapshot(other.scene).lights.size(), 1u);
  EXPECT_EQ(take_snapshot(other.scene).lights[0].range, 3.0f);
}

TEST_F(GltfRepair, Cameras) {
  for (const char* near : {"0", "-1"}) {
    const Loaded loaded = load_text(gltf_of(R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":)" +
                                            std::string(near) + R"(,"zfar":100}}])"));
    EXPECT_GT(loaded.scene.cameras.at(0).znear, 0.0f);
    EXPECT_FALSE(loaded.warnings.empty());
  }
  const Camera camera = mended_camera("perspective", R"("yfov":1,"znear":5,"zfar":5)", "zfar");
  EXPECT_GT(camera.zfar, camera.znear);
  for (const char* yfov : {"0", "-1", "3.2"})
    EXPECT_NEAR(mended_camera("perspective", R"("znear":1,"yfov":)" + std::string(yfov), "yfov").yfov, 0.785f, 1e-3f);
  EXPECT_EQ(mended_camera("orthographic", R"("znear":0,"zfar":9,"ymag":0)", "ymag").half_height, 1.0f);
}

TEST_F(GltfRepair, Materials) {
  EXPECT_EQ(mended_material(R"("emissiveFactor":[-1,2,3])", "emissiveFactor").emission, glm::vec3(0, 2, 3));
  EXPECT_EQ(mended_material(R"("alphaMode":"X")", "alphaMode").alpha_mode, AlphaMode::kOpaque);
  const Material bright = load_text(gltf_of(R"("materials":[{"emissiveFactor":[1e30,0,0],
      "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":1e30}}}])"))
                              .scene.materials.at(0);
  EXPECT_EQ(bright.emission, glm::vec3(kMaxLight, 0, 0));
  EXPECT_EQ(mended_material(R"("pbrMetallicRoughness":{"metallicFactor":0,"baseColorFactor":[0.5,null,0,1]})",
                            "pbrMetallicRoughness.baseColorFactor")
                .base_color,
            glm::vec4(1.0f));
}

TEST_F(GltfRepair, NotANumberInPositionsLeavesOutItsTriangles) {
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    GltfBuilder builder;
    const Primitive p = mended_attribute(builder, "POSITION", builder.vec3({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, bad, 0}));
    EXPECT_EQ(p.indices, (std::vector<std::uint32_t>{0, 1, 2}));
  }
}

TEST_F(GltfRepair, NotANumberInOtherAttributes) {
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    GltfBuilder builder;
    EXPECT_EQ(mended_attribute(builder, "TEXCOORD_0", builder.vec2({bad, 1, 0, 0, 1, 0, 1, 1})).texcoords[0][1],
              glm::vec2(0.0f));
    GltfBuilder second;
    const Primitive far = mended_attribute(second, "TEXCOORD_3", second.vec2({0, 0, 1, 0, 1, bad, 0, 1}));
    EXPECT_EQ(far.texcoords[3][2], glm::vec2(0.0f));
    EXPECT_EQ(far.texcoords[3][1], glm::vec2(1, 0));
    GltfBuilder third;
    const Primitive normals = mended_attribute(third, "NORMAL", third.vec3({0, 0, 1, bad, 0, 0, 0, 0, 1, 0, 0, 1}));
    for (const glm::vec3& normal : normals.normals) EXPECT_VEC3_NEAR(normal, glm::vec3(0, 0, 1), 1e-6f);
  }
}

TEST_F(GltfRepair, VertexColors) {
  GltfBuilder builder;
  const Primitive bad = mended_attribute(builder, "COLOR_0", builder.vec3({kNan, 0.5f, 2, 0, -1, 0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(bad.colors[0], glm::vec4(1.0f, 0.5f, 1.0f, 1.0f));
  EXPECT_EQ(bad.colors[1], glm::vec4(0, 0, 0, 1));
  // Bytes that the file forgets to call normalised.
  GltfBuilder bytes;
  const int view = bytes.view(std::vector<std::uint8_t>{255, 0, 51, 255, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2});
  const int accessor =
      bytes.accessor(R"("bufferView":)" + std::to_string(view) + R"(,"componentType":5121,"type":"VEC4","count":4)");
  const Loaded loaded = load_text(quad(bytes, "COLOR_0", accessor));
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(first_primitive(loaded.scene).colors[0], glm::vec4(1.0f, 0.0f, 0.2f, 1.0f));
}

TEST_F(GltfRepair, MorphTargetsAndWeightsOfDifferentNumber) {
  const auto mesh = [](GltfBuilder& builder, const std::string& targets, const std::string& weights,
                       const std::string& node) {
    const std::string position = std::to_string(builder.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0}));
    return builder.text(R"("nodes":[{"mesh":0)" + node + R"(}],"meshes":[{"weights":)" + weights +
                        R"(,"primitives":[{"attributes":{"POSITION":)" + position + R"(},"targets":[)" + targets +
                        R"(]},{"attributes":{"POSITION":)" + position + "}" +
                        (targets.empty() ? "}" : R"(,"targets":[)" + targets + "]}") + "]}]");
  };
  GltfBuilder a;
  EXPECT_TRUE(mended_text(mesh(a, "", "[0.5]", ""), "meshes[0].weights").meshes.at(0).morph_weights.empty());
  GltfBuilder b;
  EXPECT_EQ(mended_text(mesh(b, "{},{}", "[0.5]", ""), "meshes[0].weights").meshes.at(0).morph_weights,
            (std::vector<float>{0.5f, 0.0f}));
  GltfBuilder c;
  EXPECT_EQ(mended_text(mesh(c, "{}", "[0.5]", R"(,"weights":[1,2,3])"), "nodes[0].weights").nodes.at(0).morph_weights,
            (std::vector<float>{1.0f}));
  GltfBuilder d;
  const std::string position = std::to_string(d.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  const Scene uneven = mended_text(d.text(R"("meshes":[{"primitives":[{"attributes":{"POSITION":)" + position +
                                          R"(},"targets":[{},{}]},{"attributes":{"POSITION":)" + position + "}}]}]"),
                                   "meshes[0]");
  EXPECT_EQ(uneven.meshes.at(0).primitives.at(1).morph_targets.size(), 2u);
}

TEST_F(GltfRepair, DamagedAnimationsAndSkins) {
  for (const auto& [times, values] : {std::pair{std::vector<float>{1, 0}, std::vector<float>{0, 0, 0, 1, 1, 1}},
                                      std::pair{std::vector<float>{0, kNan}, std::vector<float>{0, 0, 0, 1, 1, 1}},
                                      std::pair{std::vector<float>{0, 1}, std::vector<float>{0, 0, 0, 1, kNan, 1}}}) {
    GltfBuilder builder;
    const std::string input = std::to_string(builder.floats("SCALAR", 1, times));
    const std::string output = std::to_string(builder.vec3(values));
    const Loaded loaded = load_text(
        builder.text(R"("nodes":[{}],"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"scale"}}],
        "samplers":[{"input":)" +
                     input + R"(,"output":)" + output + "}]}]"));
    EXPECT_TRUE(loaded.scene.animations.empty());
    EXPECT_NE(loaded.warnings.at(0).find("animations[0].samplers[0]"), std::string::npos);
  }
  GltfBuilder builder;
  std::vector<float> matrix(16, 0.0f);
  matrix[5] = kNan;
  const std::string matrices = std::to_string(builder.floats("MAT4", 16, matrix));
  const Scene scene =
      mended_text(builder.text(R"("nodes":[{}],"skins":[{"joints":[0],"inverseBindMatrices":)" + matrices + "}]"),
                  "skins[0].inverseBindMatrices");
  EXPECT_EQ(scene.skins.at(0).inverse_bind_matrices.at(0), glm::mat4(1.0f));
}

TEST_F(GltfRepair, SpecularGlossinessGivesItsDiffuseColor) {
  for (const char* others : {"", R"("glossinessFactor":0,)", R"("unknown":1,)"}) {
    const Loaded loaded =
        load_text(gltf_of(R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1],"metallicFactor":0},
        "extensions":{"KHR_materials_pbrSpecularGlossiness":{)" +
                          std::string(others) + R"("diffuseFactor":[0.1,0.2,0.3,0.4]}}}])"));
    EXPECT_EQ(loaded.scene.materials.at(0).base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(loaded.warnings.size(), std::string(others).find("unknown") == std::string::npos ? 0u : 1u);
  }
}

TEST_F(GltfRepair, InstancesOfAMeshAreNodes) {
  const auto load_instances = [&](bool turned, bool scaled) {
    GltfBuilder builder;
    const int position = builder.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
    std::string attributes = "\"TRANSLATION\":" + std::to_string(builder.vec3({-2, 0, 0, 0, 0, 0, 2, 0, kNan}));
    if (turned)
      attributes += ",\"ROTATION\":" + std::to_string(builder.floats("VEC4", 4, {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 1}));
    if (scaled) attributes += ",\"SCALE\":" + std::to_string(builder.vec3({1, 1, 1, 3, 3, 3, 1, 1, 1}));
    return load_text(builder.text(
        R"("nodes":[{"translation":[0,5,0],"mesh":0,"children":[1],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{)" +
        attributes + R"(}}}},{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
        std::to_string(position) + "}}]}]"));
  };
  for (const bool turned : {false, true})
    for (const bool scaled : {false, true}) {
      const Loaded loaded = load_instances(turned, scaled);
      EXPECT_EQ(loaded.warnings.size(), 1u);  // of the number that is none
      const SceneSnapshot snapshot = take_snapshot(loaded.scene);
      ASSERT_EQ(snapshot.instances.size(), 4u);  // three, and the child
      const glm::mat4& first = snapshot.instances[0].to_world;
      EXPECT_VEC3_NEAR(glm::vec3(first[3]), glm::vec3(-2, 5, 0), 1e-6f);
      EXPECT_VEC3_NEAR(glm::vec3(first[0]), glm::vec3(turned ? -1 : 1, 0, 0), 1e-6f);
      EXPECT_NEAR(glm::length(glm::vec3(snapshot.instances[1].to_world[0])), scaled ? 3.0f : 1.0f, 1e-6f);
      EXPECT_VEC3_NEAR(glm::vec3(snapshot.instances[2].to_world[3]), glm::vec3(0, 5, 0), 1e-6f);
    }
}

TEST_F(GltfRepair, HiddenNodesShowNothing) {
  const std::string light = R"("KHR_lights_punctual":{"light":0})";
  const Loaded loaded = load_text(gltf_of(
      R"("extensionsRequired":["KHR_node_visibility"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},
      "nodes":[{"children":[1],"extensions":{"KHR_node_visibility":{"visible":false},)" +
      light + R"(}},{"extensions":{)" + light + R"(}},{"extensions":{"KHR_node_visibility":{"visible":true},)" + light +
      "}}]"));
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(take_snapshot(loaded.scene).lights.size(), 1u);
}

}  // namespace
}  // namespace lightwell
