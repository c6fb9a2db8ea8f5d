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

glsl::ShadowView view_of(const WorldLight& light, const Bounds& bounds) {
  return make_shadow_views(std::vector<WorldLight>{light}, bounds, {}, 512, kMaximumAtlasSide).views[0];
}

TEST(ShadowViews, DirectionalViewHoldsTheWholeScene) {
  const glsl::ShadowView light = view_of(sun(), kRoom);
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

std::vector<glsl::ShadowView> chain_of(const WorldLight& light, const Bounds& bounds,
                                       const std::vector<FocusBall>& balls) {
  const ShadowViews made = make_shadow_views(std::vector<WorldLight>{light}, bounds, balls, 512, kMaximumAtlasSide);
  std::vector<glsl::ShadowView> chain{made.views[0]};
  while (chain.back().wider != 0) chain.push_back(made.views[chain.back().wider]);
  EXPECT_EQ(chain.size(), made.views.size());
  EXPECT_EQ(made.atlas.shrunk, 1u);
  return chain;
}

bool is_within(const glsl::ShadowView& view, const glm::vec3& point) {
  const glm::vec4 clip = view.to_shadow * glm::vec4(point, 1.0f);
  return std::max(std::abs(clip.x), std::abs(clip.y)) < usable(view) * clip.w && clip.z > 0.0f && clip.z < clip.w;
}

const Bounds kGround{{-5000, -1, -5000}, {5000, 2.5f, 5000}};

// Of a sun, and of a lamp three times as far away as the ground is long.
TEST(ShadowViews, EachBallOfALargeSceneHasAViewWithinTheNext) {
  for (const bool is_sun : {true, false}) {
    const WorldLight light = is_sun ? sun() : lamp(-40000.0f * sun().direction);
    const std::vector<FocusBall> balls = make_focus_balls(kGround, {1234, 1.5f, -987}, {}, {});
    const std::vector<glsl::ShadowView> chain = chain_of(light, kGround, balls);
    ASSERT_EQ(chain.size(), balls.size() + 1);
    for (std::size_t k = 0; k < balls.size(); ++k) {
      EXPECT_LT(chain[k].texel_size, chain[k + 1].texel_size);
      for (int i = 0; i < 6; ++i) {
        glm::vec3 side(0.0f);
        side[i / 2] = i % 2 == 0 ? 0.95f : -0.95f;
        const glm::vec3 point = glm::clamp(balls[k].center + balls[k].radius * side, kGround.minimum, kGround.maximum);
        EXPECT_TRUE(is_within(chain[k], point)) << "ball " << k;
        EXPECT_TRUE(is_within(chain[k + 1], point)) << "ball " << k;
      }
    }
    for (const glm::vec3& corner : corners(kGround)) EXPECT_TRUE(is_within(chain.back(), corner));
    const float texel = chain[0].texel_size * (is_sun ? 1.0f : 40000.0f);
    EXPECT_LT(texel, 0.025f);  // of 1024; a picture's 2048 have half
    RecordProperty(is_sun ? "sun_texel" : "lamp_texel", std::to_string(texel));
  }
}

TEST(ShadowViews, AFocusThatMovesShiftsItsViewsByWholeTexels) {
  const std::vector<FocusBall> first = make_focus_balls(kGround, {10, 1.5f, 20}, {}, {});
  const std::vector<FocusBall> second = make_focus_balls(kGround, {13, 1.5f, 22}, {}, first);
  ASSERT_NE(first[0].center, second[0].center);
  EXPECT_EQ(first[1], second[1]);
  for (const bool is_sun : {true, false}) {
    const WorldLight light = is_sun ? sun() : lamp(-40000.0f * sun().direction);
    const std::vector<glsl::ShadowView> a = chain_of(light, kGround, first);
    const std::vector<glsl::ShadowView> b = chain_of(light, kGround, second);
    ASSERT_EQ(a[0].texel_size, b[0].texel_size);
    const auto place = [](const glsl::ShadowView& view) {
      const glm::vec4 clip = view.to_shadow * glm::vec4(11, 1, 21, 1);
      return glm::vec2(clip) / clip.w * 0.5f * static_cast<float>(view.tile_side);
    };
    const glm::vec2 shift = place(a[0]) - place(b[0]);
    EXPECT_GT(glm::length(shift), 10.0f);
    EXPECT_LT(glm::length(shift - glm::round(shift)), 0.1f);
    EXPECT_EQ(a[1].to_shadow, b[1].to_shadow);
  }
}

TEST(ShadowViews, SpotViewHoldsItsCone) {
  const float angle = 0.7f;
  const glsl::ShadowView light = view_of(spot(angle), kRoom);
  EXPECT_EQ(light.kind, glsl::kShadowPerspective);
  for (int i = 0; i < 16; ++i) {
    const float phi = static_cast<float>(i) * 0.4f;
    const glm::vec3 ray(std::sin(angle) * std::cos(phi), -std::cos(angle), std::sin(angle) * std::sin(phi));
    const glm::vec4 clip = light.to_shadow * glm::vec4(light.position + 1.5f * ray, 1.0f);
    EXPECT_LE(std::abs(clip.x), usable(light) * clip.w * 1.0001f);
    EXPECT_LE(std::abs(clip.y), usable(light) * clip.w * 1.0001f);
    EXPECT_NEAR(clip.w, 1.5f * std::cos(angle), 1e-5f);
  }
  EXPECT_EQ(view_of(spot(1.4f), kRoom).kind, glsl::kShadowCube);
}

TEST(ShadowViews, DirectionalTexelsStandStillWhileBoundsMove) {
  Bounds moved = kRoom;
  moved.maximum.x += 0.01f;
  const glsl::ShadowView a = view_of(sun(), kRoom);
  const glsl::ShadowView b = view_of(sun(), moved);
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
      const glsl::ShadowView view = view_of(lamp(position), kRoom);
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
  const glsl::ShadowView near_lamp = view_of(lamp(middle - 5.0f * sun().direction), kRoom);
  EXPECT_EQ(near_lamp.kind, glsl::kShadowCube);
  const glsl::ShadowView far_lamp = view_of(lamp(middle - distance * sun().direction), kRoom);
  EXPECT_LT(far_lamp.texel_size * distance, 1.1f * view_of(sun(), kRoom).texel_size);
}

TEST(ShadowViews, SpotsFromAfarSeeTheSceneOrTheirConeWhicheverIsNarrower) {
  const auto far_spot = [](float angle) {
    WorldLight light = spot(angle);
    light.position = {0, 100, 0};
    return view_of(light, kRoom);
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
  const glsl::ShadowView a = view_of(light, kRoom);
  const glsl::ShadowView b = view_of(light, moved);
  for (int column = 0; column < 4; ++column) {
    EXPECT_EQ(a.to_shadow[column].x, b.to_shadow[column].x);
    EXPECT_EQ(a.to_shadow[column].y, b.to_shadow[column].y);
    EXPECT_EQ(a.to_shadow[column].w, b.to_shadow[column].w);
  }
}

}  // namespace
}  // namespace lightwell
