#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "scene/test_files.h"

namespace lightwell {
namespace {

// One of everything.
Scene valid_scene() {
  Scene scene;
  Texture& texture = scene.textures.emplace_back();
  texture.width = texture.height = 1;
  texture.rgba.assign(4, 255);
  scene.materials.emplace_back().base_color_texture.texture = 0;
  Mesh& mesh = scene.meshes.emplace_back();
  mesh.morph_weights = {0.0f};
  Primitive& p = mesh.primitives.emplace_back();
  p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  p.normals.assign(3, {0, 0, 1});
  p.texcoords[0].assign(3, {0, 0});
  p.joints.assign(3, glm::u16vec4(0));
  p.weights.assign(3, {1, 0, 0, 0});
  p.morph_targets.emplace_back().positions.assign(3, glm::vec3(0.0f));
  p.indices = {0, 1, 2};
  p.material = 0;
  scene.nodes.resize(2);
  scene.nodes[1].parent = 0;
  scene.nodes[1].mesh = scene.nodes[1].skin = scene.nodes[1].camera = scene.nodes[1].light = 0;
  scene.skins.push_back({{0}, {glm::mat4(1.0f)}});
  scene.lights.emplace_back().type = LightType::kSpot;
  scene.cameras.emplace_back();
  scene.animations.push_back(
      {"a", {{0, AnimationPath::kTranslation, Interpolation::kLinear, {0, 1}, {0, 0, 0, 1, 1, 1}}}});
  return scene;
}

TEST(Validate, AcceptsAWholeScene) {
  EXPECT_NO_THROW(validate(valid_scene(), "scene"));
}

TEST(Validate, RejectsEveryFault) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto primitive = [](Scene& s) -> Primitive& { return s.meshes[0].primitives[0]; };
  const std::vector<std::function<void(Scene&)>> faults = {
      [](Scene& s) { s.textures[0].rgba.pop_back(); },
      [](Scene& s) { s.textures[0].width = 0; },
      [](Scene& s) { s.textures[0].height = 1 << 20; },
      [](Scene& s) { s.materials[0].base_color_texture.texture = 1; },
      [](Scene& s) { s.materials[0].emission_texture.texture = -2; },
      [](Scene& s) { s.materials[0].emission_texture.texcoord = 4; },
      [](Scene& s) { s.materials[0].base_color_texture.transform[2][0] = kNan; },
      [](Scene& s) { s.materials[0].emission.g = kInfinity; },
      [](Scene& s) { s.materials[0].emission.g = -1.0f; },
      [](Scene& s) { s.materials[0].alpha_cutoff = kNan; },
      [&](Scene& s) { primitive(s).indices[1] = 3; },
      [&](Scene& s) { primitive(s).indices.pop_back(); },
      [&](Scene& s) { primitive(s).positions[2].z = kNan; },
      [&](Scene& s) { primitive(s).positions[2].z = 2e9f; },
      [&](Scene& s) { primitive(s).normals.pop_back(); },
      [&](Scene& s) { primitive(s).normals[0].x = kInfinity; },
      [&](Scene& s) { primitive(s).texcoords[1].resize(2); },
      [&](Scene& s) { primitive(s).texcoords[0][0].x = kNan; },
      [&](Scene& s) { primitive(s).weights.clear(); },
      [&](Scene& s) { primitive(s).joints[0][3] = 1; },
      [&](Scene& s) { primitive(s).morph_targets[0].positions.pop_back(); },
      [&](Scene& s) { primitive(s).morph_targets.clear(); },
      [&](Scene& s) { primitive(s).material = 1; },
      [](Scene& s) { s.nodes[0].parent = 0; },
      [](Scene& s) { s.nodes[0].parent = 1; },
      [](Scene& s) { s.nodes[1].mesh = 1; },
      [](Scene& s) { s.nodes[1].skin = 1; },
      [](Scene& s) { s.nodes[1].camera = 1; },
      [](Scene& s) { s.nodes[1].light = -2; },
      [](Scene& s) {
        s.nodes[1].morph_weights = {0.0f, 0.0f};
      },
      [](Scene& s) { s.nodes[0].translation.x = kNan; },
      [](Scene& s) { s.nodes[0].scale = s.nodes[1].scale = glm::vec3(1e30f); },
      [](Scene& s) { s.skins[0].joints[0] = 2; },
      [](Scene& s) { s.skins[0].joints.clear(), s.skins[0].inverse_bind_matrices.clear(); },
      [](Scene& s) { s.skins[0].inverse_bind_matrices.clear(); },
      [](Scene& s) { s.skins[0].inverse_bind_matrices[0][3][0] = kNan; },
      [](Scene& s) { s.lights[0].intensity.b = kNan; },
      [](Scene& s) { s.lights[0].intensity.b = -1.0f; },
      [](Scene& s) { s.lights[0].intensity.b = 2e18f; },
      [](Scene& s) { s.lights[0].inner_angle = s.lights[0].outer_angle; },
      [](Scene& s) { s.lights[0].outer_angle = 2.0f; },
      [](Scene& s) { s.cameras[0].yfov = 0.0f; },
      [](Scene& s) { s.cameras[0].znear = 0.0f; },
      [](Scene& s) { s.cameras[0].zfar = s.cameras[0].znear; },
      [](Scene& s) { s.cameras[0].zfar = kInfinity; },
      [](Scene& s) { s.animations[0].channels[0].node = -1; },
      [](Scene& s) {
        s.animations[0].channels[0].times = {1, 0};
      },
      [](Scene& s) { s.animations[0].channels[0].times[1] = kNan; },
      [](Scene& s) { s.animations[0].channels[0].values.pop_back(); },
      [](Scene& s) { s.animations[0].channels[0].path = AnimationPath::kRotation; },
      [](Scene& s) { s.environment.radiance.r = kNan; },
      [](Scene& s) { s.environment.map = Image(2, 2, 1); },
      [](Scene& s) { s.environment.map = Image(1, 1), s.environment.map.pixels[0] = kNan; },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    Scene scene = valid_scene();
    faults[i](scene);
    try {
      validate(scene, "some file");
      ADD_FAILURE() << "fault " << i << " was accepted";
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("some file: ")) << error.what();
    }
  }
}

}  // namespace
}  // namespace lightwell
