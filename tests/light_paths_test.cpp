// The flux of light points against the path tracer and closed forms, for every kind of source.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "core/luminance.h"
#include "graph/testing/device_test.h"
#include "passes/light_paths/testing/light_path_frames.h"
#include "reference/reflected_flux.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 5;
constexpr std::uint32_t kPaths = 65536;
constexpr std::uint32_t kSurfaces = 4;
constexpr std::uint32_t kTruthSamples = 1u << 20;

// ---- sources ----

// A dim sky with a sun of three by three texels that gives half of the light.
Environment sunny_sky() {
  Environment environment;
  environment.radiance = glm::vec3(1.0f);
  environment.map = Image(128, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      const bool sun = std::abs(x - 40) <= 1 && std::abs(y - 18) <= 1;
      float* rgb = environment.map.at(x, y);
      rgb[0] = sun ? 400.0f : 0.3f;
      rgb[1] = sun ? 350.0f : 0.4f;
      rgb[2] = sun ? 300.0f : 0.6f * static_cast<float>(64 - y) / 64.0f;
    }
  }
  return environment;
}

// ---- scenes ----

// A ball of few triangles whose normals are the sphere's.
Primitive make_coarse_ball(const glm::vec3& center, float radius) {
  constexpr std::uint32_t kRows = 5;
  constexpr std::uint32_t kColumns = 8;
  Primitive ball;
  for (std::uint32_t row = 0; row <= kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const float polar = std::numbers::pi_v<float> * static_cast<float>(row) / kRows;
      const float longitude = 2.0f * std::numbers::pi_v<float> * static_cast<float>(column) / kColumns;
      ball.normals.emplace_back(std::sin(polar) * std::cos(longitude), std::cos(polar),
                                std::sin(polar) * std::sin(longitude));
      ball.positions.push_back(center + radius * ball.normals.back());
      if (row == kRows) continue;
      const std::uint32_t a = row * kColumns + column;
      const std::uint32_t b = row * kColumns + (column + 1) % kColumns;
      for (const std::uint32_t i : {a, b, a + kColumns, b, b + kColumns, a + kColumns}) ball.indices.push_back(i);
    }
  }
  return ball;
}

// A screen whose alpha mask is a chequerboard.
Material make_screen(Scene& scene) {
  Texture texture;
  texture.width = texture.height = 2;
  texture.rgba = {200, 80, 80, 255, 200, 80, 80, 0, 80, 200, 80, 0, 80, 200, 80, 255};
  texture.nearest = true;
  scene.textures.push_back(texture);
  Material material = make_material(glm::vec3(1.0f));
  material.base_color_texture.texture = 0;
  material.base_color_texture.transform = {3.0f, 0.0f, 0.0f, 3.0f, 0.0f, 0.0f};
  material.alpha_mode = AlphaMode::kMask;
  return material;
}

// A room of 4 x 3 x 4 m whose walls differ, with a table, a ball and a screen; open: without its front and its roof.
Scene make_room(bool open) {
  const Material white = make_material({0.8f, 0.8f, 0.8f});
  const Material red = make_material({0.7f, 0.2f, 0.1f});
  const Material green = make_material({0.1f, 0.6f, 0.2f});
  const Material wood = make_material({0.6f, 0.4f, 0.2f});
  Scene scene;
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, wood);
  add_quad(scene, {-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, white);
  add_quad(scene, {-2, 0, 2}, {0, 0, -4}, {0, 3, 0}, red);
  add_quad(scene, {2, 0, -2}, {0, 0, 4}, {0, 3, 0}, green);
  add_quad(scene, {-1, 1, 0.5f}, {1.5f, 0, 0}, {0, 0, -1}, wood);
  add_quad(scene, {0.2f, 0, -1}, {1.5f, 0, 0.5f}, {0, 1.2f, 0}, make_screen(scene));
  add_primitive(scene, make_coarse_ball({-1.2f, 1.8f, -0.5f}, 0.5f), green);
  if (open) return scene;
  add_quad(scene, {-2, 3, -2}, {4, 0, 0}, {0, 0, 4}, white);
  add_quad(scene, {2, 0, 2}, {-4, 0, 0}, {0, 3, 0}, white);
  return scene;
}

void add_lamp(Scene& scene, bool double_sided) {
  Material lamp = make_material({0.3f, 0.3f, 0.3f}, {3, 2, 1});
  lamp.double_sided = double_sided;
  add_quad(scene, {0.5f, 2, 0}, {0.6f, 0, 0}, {0, 0.2f, 0.4f}, lamp);
}

struct Source {
  const char* name;
  std::vector<WorldLight> lights;
  std::function<void(Scene&)> add = [](Scene&) {};  // what is no light
  bool in_open_room = true;
  bool in_closed_room = true;
};

const std::vector<Source> kSources{
    {"point", {make_point_light({0.5f, 2, 0.3f}, {1, 2, 3})}},
    {"spot", {make_spot_light({0.5f, 2.5f, 0.3f}, {-0.4f, -1, -0.3f}, 20, 45, {3, 2, 1})}},
    {"wide_spot",
     {make_spot_light({0.5f, 2.5f, 0.3f}, {-0.4f, -1, -0.3f}, 30, 80, {3, 2, 1})},
     [](Scene&) {},
     true,
     false},
    {"sun", {make_sun({-0.4f, -1, -0.3f}, {3, 2, 1})}, [](Scene&) {}, true, false},
    {"far_point", {make_point_light({30, 60, 40}, {9000, 8000, 7000})}, [](Scene&) {}, true, false},
    {"far_spot",
     {make_spot_light({30, 60, 40}, {-30, -58, -40}, 0, 10, {9000, 8000, 7000})},
     [](Scene&) {},
     true,
     false},
    {"three_lights",
     {make_point_light({0.5f, 2, 0.3f}, {1, 2, 3}),
      make_spot_light({0.5f, 2.5f, 0.3f}, {-0.4f, -1, -0.3f}, 20, 45, {9, 2, 1}),
      make_sun({-0.4f, -1, -0.3f}, {0.3f, 0.2f, 0.5f})},
     [](Scene&) {},
     false},
    {"lamp", {}, [](Scene& scene) { add_lamp(scene, false); }},
    {"two_sided_lamp", {}, [](Scene& scene) { add_lamp(scene, true); }, true, false},
    {"sky",
     {},
     [](Scene& scene) {
       scene.environment.radiance = {0.8f, 1.0f, 1.2f};
     },
     true,
     false},
    {"sunny_sky", {}, [](Scene& scene) { scene.environment = sunny_sky(); }, true, false},
};

struct FluxCase {
  const Source* source;
  bool open;
};

void PrintTo(const FluxCase& c, std::ostream* out) {
  *out << c.source->name << (c.open ? "_open" : "_closed");
}

std::vector<FluxCase> list_flux_cases() {
  std::vector<FluxCase> cases;
  for (const Source& source : kSources) {
    if (source.in_open_room) cases.push_back({&source, true});
    if (source.in_closed_room) cases.push_back({&source, false});
  }
  return cases;
}

class LightPathFlux : public DeviceTest, public ::testing::WithParamInterface<FluxCase> {};

// Every channel: of the first surface within 1 %, of the further ones within 5 %.
TEST_P(LightPathFlux, IsThePathTracers) {
  const FluxCase c = GetParam();
  Scene scene = make_room(c.open);
  c.source->add(scene);
  SceneSnapshot world = take_snapshot(scene);
  world.lights = c.source->lights;
  const ReflectedFlux truth = integrate_reflected_flux(scene, world, kSurfaces, kTruthSamples, kSeed);
  LightPathFrames frames(device(), scene, world);
  for (const bool maps : {false, true}) {
    if (maps && world.lights.empty()) continue;
    SCOPED_TRACE(std::string(maps ? "from maps" : "as rays") + ", seed " + std::to_string(kSeed));
    frames.settings = {.paths = kPaths, .bounces = kSurfaces, .rsm_lights = maps ? 16u : 0u};
    const LightPoints points = frames.next();
    const glm::dvec3 first = sum_bounce(points, kPaths, 1) / truth.first;
    const glm::dvec3 further = sum_flux(points, kPaths, points.size()) / truth.further;
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(first[channel], 1.0, 0.01) << "channel " << channel;
      EXPECT_NEAR(further[channel], 1.0, 0.05) << "channel " << channel;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sources, LightPathFlux, ::testing::ValuesIn(list_flux_cases()),
                         [](const auto& info) { return ::testing::PrintToString(info.param); });

}  // namespace
}  // namespace lightwell
