#include "passes/shadow_maps/light_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lightwell {
namespace {

const Bounds kRoom{{-3, 0, -2}, {3, 2.5f, 2}};

WorldLight sun() {
  WorldLight light;
  light.type = LightType::kDirectional;
  light.direction = glm::normalize(glm::vec3(0.3f, -1.0f, 0.5f));
  return light;
}

WorldLight spot(float angle) {
  WorldLight light;
  light.type = LightType::kSpot;
  light.position = {0, 2, 0};
  light.direction = {0, -1, 0};
  light.cos_outer = std::cos(angle);
  return light;
}

WorldLight lamp(const glm::vec3& position) {
  WorldLight light;
  light.position = position;
  return light;
}

std::vector<glm::vec3> corners(const Bounds& bounds) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back(glm::mix(bounds.minimum, bounds.maximum, glm::vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1)));
  }
  return points;
}

// Half the width of what a filter's centre may see, NDC.
float usable(const glsl::GpuLight& light) {
  return 1.0f - 2.0f * static_cast<float>(glsl::kShadowGuard) / static_cast<float>(light.tile_side);
}

struct Rectangle {
  glm::uvec2 from, to;
};

std::vector<Rectangle> tiles(const LightViews& views) {
  std::vector<Rectangle> all;
  for (const glsl::GpuLight& light : views.lights) {
    for (std::uint32_t view = 0; view < count_views(light); ++view) {
      const glm::uvec2 from = light.tile + light.tile_side * glm::uvec2(view % 3, view / 3);
      all.push_back({from, from + light.tile_side});
    }
  }
  return all;
}

void expect_sound(const LightViews& views) {
  const std::vector<Rectangle> all = tiles(views);
  EXPECT_LE(views.atlas_width, kMaximumAtlasSide);
  EXPECT_LE(views.atlas_height, kMaximumAtlasSide);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_LE(all[i].to.x, views.atlas_width);
    EXPECT_LE(all[i].to.y, views.atlas_height);
    for (std::size_t j = 0; j < i; ++j) {
      const bool apart = all[i].from.x >= all[j].to.x || all[j].from.x >= all[i].to.x || all[i].from.y >= all[j].to.y ||
                         all[j].from.y >= all[i].to.y;
      ASSERT_TRUE(apart) << "tiles " << i << " and " << j << " overlap";
    }
  }
}

TEST(LightViews, TilesFitAndNeverOverlap) {
  std::vector<WorldLight> lights{sun(), spot(0.5f), lamp({0, 1, 0}), spot(1.4f), sun(), lamp({1, 1, 0})};
  expect_sound(make_light_views(lights, kRoom, kRoom, 1024));
  expect_sound(make_light_views({}, kRoom, kRoom, 1024));
}

TEST(LightViews, ManyLightsShareTheAtlasInSmallerTiles) {
  std::vector<WorldLight> lights(500, lamp({0, 1, 0}));
  lights.push_back(sun());
  const LightViews views = make_light_views(lights, kRoom, kRoom, 1024);
  expect_sound(views);
  EXPECT_LT(views.lights[0].tile_side, 256u);
  EXPECT_EQ(tiles(views).size(), 3001u);
}

TEST(LightViews, LightsBeyondTheSmallestTilesCastNoShadows) {
  const std::vector<WorldLight> lights(5000, lamp({0, 1, 0}));
  const LightViews views = make_light_views(lights, kRoom, kRoom, 1024);
  ASSERT_EQ(views.lights.size(), 5000u);
  EXPECT_EQ(views.lights.front().shadow_kind, glsl::kShadowCube);
  EXPECT_EQ(views.lights.back().shadow_kind, glsl::kShadowNone);
}

TEST(LightViews, DirectionalViewHoldsTheWholeScene) {
  const LightViews views = make_light_views(std::vector<WorldLight>{sun()}, kRoom, kRoom, 512);
  const glsl::GpuLight& light = views.lights[0];
  EXPECT_EQ(light.shadow_kind, glsl::kShadowSingle);
  for (const glm::vec3& corner : corners(kRoom)) {
    const glm::vec4 clip = light.to_shadow * glm::vec4(corner, 1.0f);
    EXPECT_EQ(clip.w, 1.0f);
    EXPECT_LT(std::abs(clip.x), usable(light));
    EXPECT_LT(std::abs(clip.y), usable(light));
    EXPECT_GT(clip.z, 0.0f);
    EXPECT_LT(clip.z, 1.0f);
  }
  // Reversed: what is nearer to the light has the greater depth.
  const glm::vec4 high = light.to_shadow * glm::vec4(0, 2, 0, 1);
  const glm::vec4 low = light.to_shadow * glm::vec4(0, 0, 0, 1);
  EXPECT_GT(high.z, low.z);
}

TEST(LightViews, SmallFocusGetsAFinerViewInsideTheCoarseOne) {
  const Bounds ground{{-200, -1, -200}, {200, 2.5f, 200}};
  const LightViews views = make_light_views(std::vector<WorldLight>{sun()}, ground, kRoom, 512);
  expect_sound(views);
  const glsl::GpuLight& light = views.lights[0];
  ASSERT_EQ(light.shadow_kind, glsl::kShadowNested);
  EXPECT_LT(light.texel_size, 0.01f);
  for (const glm::vec3& corner : corners(kRoom)) {
    EXPECT_LT(std::abs((light.to_shadow * glm::vec4(corner, 1.0f)).x), usable(light));
  }
  for (const glm::vec3& corner : corners(ground)) {
    const glm::vec4 fine = light.to_shadow * glm::vec4(corner, 1.0f);
    EXPECT_LT(std::abs(fine.x * light.coarse.x + light.coarse.z), usable(light));
    EXPECT_LT(std::abs(fine.y * light.coarse.y + light.coarse.w), usable(light));
    EXPECT_GT(fine.z, 0.0f);
    EXPECT_LT(fine.z, 1.0f);
  }
}

TEST(LightViews, SpotViewHoldsItsCone) {
  const float angle = 0.7f;
  const LightViews views = make_light_views(std::vector<WorldLight>{spot(angle)}, kRoom, kRoom, 512);
  const glsl::GpuLight& light = views.lights[0];
  EXPECT_EQ(light.shadow_kind, glsl::kShadowSingle);
  for (int i = 0; i < 16; ++i) {
    const float phi = static_cast<float>(i) * 0.4f;
    const glm::vec3 ray(std::sin(angle) * std::cos(phi), -std::cos(angle), std::sin(angle) * std::sin(phi));
    const glm::vec4 clip = light.to_shadow * glm::vec4(light.position + 1.5f * ray, 1.0f);
    EXPECT_LE(std::abs(clip.x), usable(light) * clip.w * 1.0001f);
    EXPECT_LE(std::abs(clip.y), usable(light) * clip.w * 1.0001f);
    EXPECT_NEAR(clip.w, 1.5f * std::cos(angle), 1e-5f);
  }
  EXPECT_EQ(make_light_views(std::vector<WorldLight>{spot(1.4f)}, kRoom, kRoom, 512).lights[0].shadow_kind,
            glsl::kShadowCube);
}

TEST(LightViews, DirectionalTexelsStandStillWhileBoundsMove) {
  Bounds moved = kRoom;
  moved.maximum.x += 0.01f;
  const auto a = make_light_views(std::vector<WorldLight>{sun()}, kRoom, kRoom, 512).lights[0];
  const auto b = make_light_views(std::vector<WorldLight>{sun()}, moved, moved, 512).lights[0];
  ASSERT_EQ(a.texel_size, b.texel_size);
  // A world position keeps its place within its texel.
  const float shift = ((a.to_shadow - b.to_shadow)[3].x * 0.5f) * static_cast<float>(a.tile_side);
  EXPECT_NEAR(shift, std::round(shift), 1e-3f);
}

TEST(LightViews, WithoutTilesNoLightHasAView) {
  const std::vector<WorldLight> lights(3);
  const LightViews views = make_light_views(lights, {glm::vec3(-1), glm::vec3(1)}, {glm::vec3(-1), glm::vec3(1)}, 0);
  ASSERT_EQ(views.lights.size(), 3u);
  for (const glsl::GpuLight& light : views.lights) EXPECT_EQ(count_views(light), 0u);
  EXPECT_EQ(views.atlas_width * views.atlas_height, 1u);
}

}  // namespace
}  // namespace lightwell
