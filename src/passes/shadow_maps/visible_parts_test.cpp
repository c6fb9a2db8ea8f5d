#include "passes/shadow_maps/visible_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "passes/shadow_maps/shadow_views.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kManyIndices = 30000;  // worth a draw of their own

PartRange make_part(std::size_t number, const Bounds& bounds, bool alpha_masked = false) {
  return {static_cast<std::uint32_t>(number) * kManyIndices, kManyIndices, bounds, alpha_masked, false};
}

bool covers(const std::vector<IndexRange>& ranges, const PartRange& part) {
  for (const IndexRange& range : ranges)
    if (range.first <= part.first_index && part.first_index + part.index_count <= range.first + range.count)
      return true;
  return false;
}

// Of one that has several the finest.
glsl::ShadowView view_of(const WorldLight& light, const Bounds& bounds) {
  const std::vector<FocusBall> balls{{glm::mix(bounds.minimum, bounds.maximum, 0.3f), 1.0f}};
  return make_shadow_views(std::vector<WorldLight>{light}, bounds, balls, 256, kMaximumAtlasSide).views[0];
}

// As the vertex shader has it (shaders/shadow_view.glsl), in double precision.
bool sees(const glsl::ShadowView& view, std::uint32_t face, const glm::dvec3& point) {
  glm::dvec4 clip;
  if (view.kind == glsl::kShadowCube) {
    const glm::dvec3 v = point - glm::dvec3(view.position);
    const glm::dvec3 faces[6] = {{v.y, v.z, v.x},  {v.y, v.z, -v.x}, {v.z, v.x, v.y},
                                 {v.z, v.x, -v.y}, {v.x, v.y, v.z},  {v.x, v.y, -v.z}};
    clip = glm::dmat4(view.to_shadow) * glm::dvec4(faces[face], 1.0);
  } else {
    clip = glm::dmat4(view.to_shadow) * glm::dvec4(point, 1.0);
  }
  return std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && clip.z >= 0.0 && clip.z <= clip.w;
}

class VisiblePartsTest : public ::testing::TestWithParam<float> {
 protected:
  float uniform() { return std::uniform_real_distribution<float>(0.0f, 1.0f)(random_); }
  glm::vec3 uniform3() { return {uniform(), uniform(), uniform()}; }
  glm::vec3 in_scene() { return glm::mix(scene_.minimum, scene_.maximum, uniform3()); }

  std::vector<WorldLight> lights() {
    std::vector<WorldLight> all(4);
    all[0].position = in_scene();
    all[1].position = scene_.maximum + 50.0f * uniform3();
    all[2].type = LightType::kSpot;
    all[2].position = in_scene();
    all[2].direction = glm::normalize(uniform3() - 0.5f);
    all[2].cos_outer = 0.8f;
    all[3].type = LightType::kDirectional;
    all[3].direction = glm::normalize(uniform3() - 0.5f);
    return all;
  }

  std::mt19937 random_{7};
  const Bounds scene_{glm::vec3(GetParam()) - glm::vec3(6, 3, 5), glm::vec3(GetParam()) + glm::vec3(6, 3, 5)};
};

// Near the world's origin and far from it.
TEST_P(VisiblePartsTest, APartWithAPointInTheViewIsDrawn) {
  std::size_t drawn = 0;
  std::size_t tested = 0;
  for (int round = 0; round < 30; ++round) {
    std::vector<PartRange> parts;
    for (std::size_t i = 0; i < 40; ++i) {
      const glm::vec3 corner = in_scene();
      parts.push_back(make_part(2 * i, {corner, corner + uniform() * uniform3()}));
    }
    for (const WorldLight& light : lights()) {
      const glsl::ShadowView view = view_of(light, scene_);
      for (std::uint32_t face = 0; face < count_views(view); ++face) {
        const std::vector<IndexRange> ranges = list_visible_ranges(parts, false, view, face);
        for (const PartRange& part : parts) {
          bool seen = false;
          for (int i = 0; i < 50 && !seen; ++i)
            seen = sees(view, face, glm::mix(part.world_bounds.minimum, part.world_bounds.maximum, uniform3()));
          if (seen) {
            ASSERT_TRUE(covers(ranges, part)) << "light type " << static_cast<int>(light.type) << ", face " << face;
          }
          drawn += covers(ranges, part) ? 1 : 0;
          ++tested;
        }
      }
    }
  }
  if (GetParam() == 0.0f) {
    EXPECT_LT(drawn, tested / 2);  // most faces of a cube see few parts
  }
}

INSTANTIATE_TEST_SUITE_P(Places, VisiblePartsTest, ::testing::Values(0.0f, 3e3f, 1e6f));

WorldLight spot_downwards() {
  WorldLight light;
  light.type = LightType::kSpot;
  light.position = {0, 5, 0};
  light.direction = {0, -1, 0};
  light.cos_outer = 0.9f;
  return light;
}

const Bounds kScene{glm::vec3(-10), glm::vec3(10)};
const Bounds kBelow{{-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}};
const Bounds kAbove{{-0.5f, 6, -0.5f}, {0.5f, 7, 0.5f}};

TEST(VisibleParts, PartsOutsideAreLeftOut) {
  const glsl::ShadowView view = view_of(spot_downwards(), kScene);
  const std::vector<PartRange> parts{make_part(0, kAbove), make_part(1, kBelow), make_part(2, kAbove)};
  const std::vector<IndexRange> ranges = list_visible_ranges(parts, false, view, 0);
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_EQ(ranges[0].first, parts[1].first_index);
  EXPECT_EQ(ranges[0].count, parts[1].index_count);
}

TEST(VisibleParts, ShortGapsAreDrawnAndLongOnesNot) {
  const glsl::ShadowView view = view_of(spot_downwards(), kScene);
  std::vector<PartRange> parts{make_part(0, kBelow), make_part(1, kAbove), make_part(2, kBelow)};
  EXPECT_EQ(list_visible_ranges(parts, false, view, 0).size(), 2u);
  parts[1].index_count = 3;
  parts[2].first_index = parts[1].first_index + 3;
  const std::vector<IndexRange> ranges = list_visible_ranges(parts, false, view, 0);
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_EQ(ranges[0].count, 2 * kManyIndices + 3);
}

TEST(VisibleParts, AlphaMaskedPartsAreAListOfTheirOwn) {
  const glsl::ShadowView view = view_of(spot_downwards(), kScene);
  const std::vector<PartRange> parts{make_part(0, kBelow), make_part(1, kBelow, true)};
  EXPECT_FALSE(covers(list_visible_ranges(parts, false, view, 0), parts[1]));
  EXPECT_FALSE(covers(list_visible_ranges(parts, true, view, 0), parts[0]));
  EXPECT_TRUE(covers(list_visible_ranges(parts, true, view, 0), parts[1]));
}

TEST(VisibleParts, BoundsThatAreNotFiniteAreDrawn) {
  const glsl::ShadowView view = view_of(spot_downwards(), kScene);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<PartRange> parts{make_part(0, {glm::vec3(-kInfinity), glm::vec3(kInfinity)})};
  EXPECT_TRUE(covers(list_visible_ranges(parts, false, view, 0), parts[0]));
}

}  // namespace
}  // namespace lightwell
