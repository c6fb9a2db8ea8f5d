#include "passes/shadow_maps/shadow_views.h"

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
float usable(const glsl::ShadowView& light) {
  return 1.0f - 2.0f * static_cast<float>(glsl::kShadowGuard) / static_cast<float>(light.tile_side);
}

glsl::ShadowView view_of(const WorldLight& light, const Bounds& bounds, const Bounds& focus) {
  return make_shadow_views(std::vector<WorldLight>{light}, bounds, focus, 512, kMaximumAtlasSide).views[0];
}

TEST(ShadowViews, DirectionalViewHoldsTheWholeScene) {
  const glsl::ShadowView light = view_of(sun(), kRoom, kRoom);
  EXPECT_EQ(light.kind, glsl::kShadowOrthographic);
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

TEST(ShadowViews, SmallFocusGetsAFinerViewInsideTheCoarseOne) {
  const Bounds ground{{-200, -1, -200}, {200, 2.5f, 200}};
  const glsl::ShadowView light = view_of(sun(), ground, kRoom);
  ASSERT_EQ(light.kind, glsl::kShadowNested);
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

TEST(ShadowViews, SpotViewHoldsItsCone) {
  const float angle = 0.7f;
  const glsl::ShadowView light = view_of(spot(angle), kRoom, kRoom);
  EXPECT_EQ(light.kind, glsl::kShadowPerspective);
  for (int i = 0; i < 16; ++i) {
    const float phi = static_cast<float>(i) * 0.4f;
    const glm::vec3 ray(std::sin(angle) * std::cos(phi), -std::cos(angle), std::sin(angle) * std::sin(phi));
    const glm::vec4 clip = light.to_shadow * glm::vec4(light.position + 1.5f * ray, 1.0f);
    EXPECT_LE(std::abs(clip.x), usable(light) * clip.w * 1.0001f);
    EXPECT_LE(std::abs(clip.y), usable(light) * clip.w * 1.0001f);
    EXPECT_NEAR(clip.w, 1.5f * std::cos(angle), 1e-5f);
  }
  EXPECT_EQ(view_of(spot(1.4f), kRoom, kRoom).kind, glsl::kShadowCube);
}

TEST(ShadowViews, DirectionalTexelsStandStillWhileBoundsMove) {
  Bounds moved = kRoom;
  moved.maximum.x += 0.01f;
  const glsl::ShadowView a = view_of(sun(), kRoom, kRoom);
  const glsl::ShadowView b = view_of(sun(), moved, moved);
  ASSERT_EQ(a.texel_size, b.texel_size);
  // A world position keeps its place within its texel.
  const float shift = ((a.to_shadow - b.to_shadow)[3].x * 0.5f) * static_cast<float>(a.tile_side);
  EXPECT_NEAR(shift, std::round(shift), 1e-3f);
}

// From every side and distance: all of the scene is within the view, deeper where farther from the light.
TEST(ShadowViews, ViewFromAfarHoldsTheWholeScene) {
  const glm::vec3 middle = 0.5f * (kRoom.minimum + kRoom.maximum);
  const float diagonal = glm::distance(kRoom.minimum, kRoom.maximum);
  for (const float distance : {1.01f, 2.0f, 30.0f, 1e3f, 1e6f}) {
    for (const glm::vec3& side : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(-3, 2, 1), glm::vec3(0, 1, 5)}) {
      const glm::vec3 position = middle + distance * diagonal * glm::normalize(side);
      const glsl::ShadowView view = view_of(lamp(position), kRoom, kRoom);
      ASSERT_EQ(view.kind, glsl::kShadowPerspective);
      for (const glm::vec3& corner : corners(kRoom)) {
        const glm::vec4 clip = view.to_shadow * glm::vec4(corner, 1.0f);
        EXPECT_LT(std::abs(clip.x), usable(view) * clip.w);
        EXPECT_LT(std::abs(clip.y), usable(view) * clip.w);
        EXPECT_GT(clip.z, 0.0f);
        EXPECT_LT(clip.z, clip.w);
        EXPECT_NEAR(clip.w, glm::dot(glm::normalize(middle - position), corner - position), 0.02f * clip.w);
      }
      const glm::vec3 step = 0.3f * glm::normalize(position - middle);
      const glm::vec4 nearer = view.to_shadow * glm::vec4(middle + step, 1.0f);
      const glm::vec4 farther = view.to_shadow * glm::vec4(middle - step, 1.0f);
      EXPECT_GT(nearer.z / nearer.w, farther.z / farther.w + 0.01f);  // 0.6 m of some 8
    }
  }
}

TEST(ShadowViews, TexelsFromAfarAreAsSmallAsTheSuns) {
  const glm::vec3 middle = 0.5f * (kRoom.minimum + kRoom.maximum);
  const float distance = 300.0f;
  const glsl::ShadowView near_lamp = view_of(lamp(middle - 5.0f * sun().direction), kRoom, kRoom);
  EXPECT_EQ(near_lamp.kind, glsl::kShadowCube);
  const glsl::ShadowView far_lamp = view_of(lamp(middle - distance * sun().direction), kRoom, kRoom);
  EXPECT_LT(far_lamp.texel_size * distance, 1.1f * view_of(sun(), kRoom, kRoom).texel_size);
}

TEST(ShadowViews, SpotsFromAfarSeeTheSceneOrTheirConeWhicheverIsNarrower) {
  const auto far_spot = [](float angle) {
    WorldLight light = spot(angle);
    light.position = {0, 100, 0};
    return view_of(light, kRoom, kRoom);
  };
  for (const float wide : {0.2f, 0.9f, 1.4f}) {
    EXPECT_EQ(far_spot(wide).kind, glsl::kShadowPerspective);
    EXPECT_EQ(far_spot(wide).texel_size, far_spot(1.0f).texel_size);
  }
  EXPECT_LT(far_spot(0.01f).texel_size * static_cast<float>(far_spot(0.01f).tile_side),
            far_spot(1.0f).texel_size * static_cast<float>(far_spot(1.0f).tile_side));
}

TEST(ShadowViews, TexelsFromAfarStandStillWhileBoundsMove) {
  Bounds moved = kRoom;
  moved.maximum.x += 0.01f;
  const WorldLight light = lamp({70, 80, 30});
  const glsl::ShadowView a = view_of(light, kRoom, kRoom);
  const glsl::ShadowView b = view_of(light, moved, moved);
  for (int column = 0; column < 4; ++column) {
    EXPECT_EQ(a.to_shadow[column].x, b.to_shadow[column].x);
    EXPECT_EQ(a.to_shadow[column].y, b.to_shadow[column].y);
    EXPECT_EQ(a.to_shadow[column].w, b.to_shadow[column].w);
  }
}

}  // namespace
}  // namespace lightwell
