// Reflective shadow maps: what texels hold, that nothing counts twice, and which maps are drawn when.
#include "passes/rsm/rsm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/luminance.h"
#include "graph/testing/device_test.h"
#include "passes/light_paths/testing/light_path_frames.h"
#include "passes/shadow_maps/shadow_views.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

using Maps = LightPathFrames::Maps;

constexpr double kPi = std::numbers::pi;
const glm::vec3 kAlbedo{0.5f, 0.25f, 0.75f};

// Flux that a light's maps reflect.
glm::dvec3 sum_maps(const Maps& maps, std::size_t light) {
  const glsl::ShadowView& view = maps.views.at(light);
  const glm::uvec2 end = view.tile + block_size(view);
  glm::dvec3 sum(0.0);
  for (std::uint32_t y = view.tile.y; y < end.y; ++y)
    for (std::uint32_t x = view.tile.x; x < end.x; ++x) sum += glm::dvec3(maps.flux[y * maps.width + x]);
  return sum;
}

// `visit(light, face, texel)` for each texel of all maps; `texel` in the atlas.
template <class Visit>
void visit_texels(const Maps& maps, const Visit& visit) {
  for (std::size_t light = 0; light < maps.views.size(); ++light) {
    const glsl::ShadowView& view = maps.views[light];
    for (std::uint32_t face = 0; face < count_views(view); ++face) {
      const glm::uvec2 corner = view.tile + view.tile_side * glm::uvec2(face % 3, face / 3);
      for (std::uint32_t y = 0; y < view.tile_side; ++y)
        for (std::uint32_t x = 0; x < view.tile_side; ++x) visit(light, face, corner + glm::uvec2(x, y));
    }
  }
}

class RsmTest : public DeviceTest {
 protected:
  static Maps draw(const Scene& scene, const std::vector<WorldLight>& lights, std::uint32_t side = 128) {
    LightPathFrames frames(device(), scene, lights);
    frames.map_settings.tile_side = side;
    return frames.next_maps();
  }

  static void expect_flux(const glm::dvec3& flux, const glm::dvec3& expected, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux[c] / expected[c], 1.0, tolerance) << "channel " << c;
  }
};

// In a closed box all of the light is reflected once: texels cover the sphere of directions without gap or overlap.
TEST_F(RsmTest, APointLightsTexelsHoldAllOfItsFlux) {
  const glm::vec3 intensity{1, 2, 3};
  const Scene box = make_box({2, 1, 3}, make_material(kAlbedo));
  for (const std::uint32_t side : {32u, 128u}) {
    const Maps maps = draw(box, {make_point_light({0.7f, 0.1f, -1.2f}, intensity)}, side);
    expect_flux(sum_maps(maps, 0), 4.0 * kPi * glm::dvec3(intensity) * glm::dvec3(kAlbedo), 1e-4);
    EXPECT_EQ(maps.width * maps.height, 8 * side * side);
  }
}

// 2 pi I ((1 - cos inner) + (cos inner - cos outer) / 3); a cone without a soft edge ends within texels.
TEST_F(RsmTest, ASpotsTexelsHoldAllOfItsFlux) {
  const Scene box = make_box({2, 1, 3}, make_material(kAlbedo));
  for (const auto& [inner, outer] : {std::pair(20.0f, 40.0f), {0.0f, 55.0f}, {45.0f, 85.0f}, {30.0f, 30.5f}}) {
    SCOPED_TRACE("cone of " + std::to_string(inner) + ", " + std::to_string(outer) + " degrees");
    const WorldLight spot = make_spot_light({0.5f, 0.2f, 0.4f}, {1, -2, 0.5f}, inner, outer, {3, 2, 1});
    const double solid_angle =
        2.0 * kPi * ((1.0 - double{spot.cos_inner}) + (double{spot.cos_inner} - double{spot.cos_outer}) / 3.0);
    expect_flux(sum_maps(draw(box, {spot}), 0), solid_angle * glm::dvec3(3, 2, 1) * glm::dvec3(kAlbedo), 0.005);
  }
}

// E times the box's projected area, whichever side its walls show.
TEST_F(RsmTest, ASunsTexelsHoldTheWholeScenesFlux) {
  const glm::vec3 half{2, 1, 3};
  const glm::vec3 direction = glm::normalize(glm::vec3(-0.3f, -1, 0.6f));
  const glm::dvec3 area = 4.0 * glm::dvec3(half.y * half.z, half.z * half.x, half.x * half.y);
  const double projected = glm::dot(area, glm::abs(glm::dvec3(direction)));
  const Maps maps = draw(make_box(half, make_material(kAlbedo)), {make_sun(direction, {3, 2, 1})});
  expect_flux(sum_maps(maps, 0), projected * glm::dvec3(3, 2, 1) * glm::dvec3(kAlbedo), 0.005);
}

// The box's solid angle from afar is its projected area over the squared distance, but for its depth.
TEST_F(RsmTest, AFarPointLightsTexelsHoldWhatMeetsTheScene) {
  const glm::vec3 half{2, 1, 3};
  const glm::vec3 position{900, 2000, -1500};
  const double distance = glm::length(glm::dvec3(position));
  const glm::dvec3 area = 4.0 * glm::dvec3(half.y * half.z, half.z * half.x, half.x * half.y);
  const double solid_angle = glm::dot(area, glm::abs(glm::dvec3(position))) / distance / (distance * distance);
  const Maps maps = draw(make_box(half, make_material(kAlbedo)), {make_point_light(position, {3e6f, 2e6f, 1e6f})});
  EXPECT_EQ(maps.views.at(0).kind, glsl::kShadowPerspective);
  expect_flux(sum_maps(maps, 0), solid_angle * glm::dvec3(3e6, 2e6, 1e6) * glm::dvec3(kAlbedo), 0.005);
}

std::vector<WorldLight> lights_of_all_kinds() {
  return {make_point_light({0, 2, 0.5f}, {1, 2, 3}), make_spot_light({2, 3, 1}, {-1, -1, -0.5f}, 10, 35, {5, 5, 5}),
          make_sun({-0.3f, -1, -0.4f}, {1, 1, 1}), make_point_light({30, 90, 60}, {9000, 9000, 9000}),
          make_spot_light({-2, 2.5f, 1}, {0, -1, 0.2f}, 20, 85, {4, 3, 2})};
}

// "textured" has alpha-masked and textured parts.
TEST_F(RsmTest, TexelsHoldWhatTheirCentresSee) {
  const Scene scene = load_scene(resolve_scene("textured"));
  const std::vector<WorldLight> lights = lights_of_all_kinds();
  const Maps maps = draw(scene, lights, 64);
  int valid = 0;
  int elsewhere = 0;
  int turned_away = 0;
  int malformed = 0;
  visit_texels(maps, [&](std::size_t light, std::uint32_t face, glm::uvec2 texel) {
    const std::size_t index = std::size_t{texel.y} * maps.width + texel.x;
    const glm::vec4 position = maps.position[index];
    if (position.w == 0.0f) {
      malformed += maps.flux[index] != glm::vec4(0.0f);
      return;
    }
    ++valid;
    const glsl::ShadowView& view = maps.views[light];
    const glm::vec4 clip = clip_from_world(view, face) * glm::vec4(glm::vec3(position), 1.0f);
    const glm::vec2 corner(view.tile + view.tile_side * glm::uvec2(face % 3, face / 3));
    const glm::vec2 place = corner + (0.5f * glm::vec2(clip) / clip.w + 0.5f) * static_cast<float>(view.tile_side);
    elsewhere += glm::distance(place, glm::vec2(texel) + 0.5f) > 0.02f;
    const WorldLight& source = lights[light];
    const glm::vec3 to_light =
        source.type == LightType::kDirectional ? -source.direction : source.position - glm::vec3(position);
    const glm::vec3 normal(maps.normal[index]);
    turned_away += glm::dot(normal, to_light) <= 0.0f;
    malformed += std::abs(glm::length(normal) - 1.0f) > 1e-4f || maps.flux[index].w < 0.0f || maps.flux[index].w > 1.0f;
  });
  EXPECT_GT(valid, 10000);
  EXPECT_EQ(elsewhere, 0);
  EXPECT_EQ(turned_away, 0);
  EXPECT_EQ(malformed, 0);
}

TEST_F(RsmTest, EachMipHoldsTheSumsOfTheOneBelow) {
  const Maps maps = draw(load_scene(resolve_scene("textured")), lights_of_all_kinds(), 64);
  ASSERT_EQ(maps.luminances.size(), 7u);
  for (std::size_t i = 0; i < maps.flux.size(); ++i)
    ASSERT_NEAR(maps.luminances[0][i], luminance(glm::vec3(maps.flux[i])), 1e-6f * maps.luminances[0][i]);
  for (std::size_t mip = 1; mip < maps.luminances.size(); ++mip) {
    const std::uint32_t width = maps.width >> mip;
    for (std::uint32_t i = 0; i < maps.luminances[mip].size(); ++i) {
      float sum = 0.0f;
      for (std::uint32_t child = 0; child < 4; ++child)
        sum += maps.luminances[mip - 1][(2 * (i / width) + child / 2) * 2 * width + 2 * (i % width) + child % 2];
      ASSERT_NEAR(maps.luminances[mip][i], sum, 1e-6f * sum) << "mip " << mip;
    }
  }
  for (std::size_t light = 0; light < maps.views.size(); ++light)
    EXPECT_NEAR(maps.powers[light] / luminance(sum_maps(maps, light)), 1.0, 1e-5) << "light " << light;
}

// A screen without opaque texels, and one without holes.
TEST_F(RsmTest, AnAlphaMaskLetsLightThrough) {
  for (const float alpha : {0.2f, 0.9f}) {
    Scene scene;
    Material screen = make_material({0, 1, 0});
    screen.base_color.a = alpha;
    screen.alpha_mode = AlphaMode::kMask;
    add_quad(scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, make_material({1, 0, 0}));
    add_quad(scene, {-5, 1, 5}, {10, 0, 0}, {0, 0, -10}, screen);
    const glm::dvec3 flux = sum_maps(draw(scene, {make_sun({0, -1, 0}, {1, 1, 1})}), 0);
    expect_flux(alpha < 0.5f ? glm::dvec3(flux.r) : glm::dvec3(flux.g), glm::dvec3(100.0), 0.02);
    EXPECT_EQ(alpha < 0.5f ? flux.g : flux.r, 0.0);
  }
}

class RsmFrames : public RsmTest {
 protected:
  void SetUp() override {
    RsmTest::SetUp();
    if (IsSkipped()) return;
    scene_ = load_scene(resolve_scene("textured"));
    world_ = take_snapshot(scene_);
    world_.lights = lights_of_all_kinds();
    frames_.emplace(device(), scene_, world_);
    frames_->map_settings.tile_side = 64;
  }

  // As maps that have drawn nothing before draw the next frame.
  void expect_fresh(const Maps& maps) {
    LightPathFrames fresh(device(), scene_, frames_->world);
    fresh.map_settings = frames_->map_settings;
    const Maps expected = fresh.next_maps();
    EXPECT_EQ(maps.flux, expected.flux);
    EXPECT_EQ(maps.position, expected.position);
    EXPECT_EQ(maps.normal, expected.normal);
    EXPECT_EQ(maps.luminances, expected.luminances);
    EXPECT_EQ(maps.powers, expected.powers);
  }

  Scene scene_;
  SceneSnapshot world_;
  std::optional<LightPathFrames> frames_;
};

TEST_F(RsmFrames, MapsAreKeptWhileNothingChanges) {
  const Maps first = frames_->next_maps();
  const Maps second = frames_->next_maps();
  EXPECT_GT(first.passes.size(), second.passes.size());
  EXPECT_EQ(second.passes, std::vector<std::string>{"rsm: powers"});
  EXPECT_EQ(first.flux, second.flux);
  expect_fresh(second);
}

TEST_F(RsmFrames, AMovedLightsMapsAreDrawnAgain) {
  frames_->next_maps();
  frames_->world.lights[1].position.x -= 0.5f;
  frames_->world.lights[0].intensity *= 2.0f;
  const Maps moved = frames_->next_maps();
  EXPECT_EQ(std::count(moved.passes.begin(), moved.passes.end(), "rsm: clear"), 1);
  expect_fresh(moved);
}

TEST_F(RsmFrames, AMovedObjectIsSeenByAll) {
  frames_->next_maps();
  frames_->world.instances.front().to_world[3].y += 0.25f;
  expect_fresh(frames_->next_maps());
}

TEST_F(RsmFrames, LightsComeAndGo) {
  frames_->next_maps();
  frames_->world.lights.erase(frames_->world.lights.begin());
  expect_fresh(frames_->next_maps());
  frames_->world.lights.clear();
  EXPECT_TRUE(frames_->next_maps().flux.empty());
  frames_->world.lights = lights_of_all_kinds();
  expect_fresh(frames_->next_maps());
}

// More lights than the atlas has room for at the size that is asked for.
TEST_F(RsmTest, TilesShrinkToFit) {
  const std::vector<WorldLight> lights(16, make_point_light({0, 0, 0}, {1, 1, 1}));
  const Maps maps = draw(make_box({1, 1, 1}, make_material(kAlbedo)), lights, 256);
  EXPECT_LE(std::max(maps.width, maps.height), 2048u);
  for (std::size_t light = 0; light < lights.size(); ++light) {
    EXPECT_EQ(maps.views[light].tile_side, 128u);
    expect_flux(sum_maps(maps, light), 4.0 * kPi * glm::dvec3(kAlbedo), 1e-4);
  }
}

// What is not finite is not drawn; the rest is.
TEST_F(RsmTest, BrokenTrianglesReflectNothing) {
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Scene scene = make_box({1, 1, 1}, make_material(kAlbedo));
    add_quad(scene, {-0.5f, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}, make_material({1, 1, 1}));
    scene.meshes.back().primitives[0].positions[2].x = value;
    const Maps maps = draw(scene, {make_point_light({0, 0.5f, 0}, {1, 1, 1}), make_sun({0.3f, -1, 0.2f}, {1, 1, 1})});
    for (const glm::vec4& flux : maps.flux)
      ASSERT_TRUE(std::isfinite(flux.r) && std::isfinite(flux.g) && std::isfinite(flux.b));
    expect_flux(sum_maps(maps, 0), 4.0 * kPi * glm::dvec3(kAlbedo), 0.05);
    EXPECT_GT(sum_maps(maps, 1).r, 0.0);
  }
}

}  // namespace
}  // namespace lightwell
