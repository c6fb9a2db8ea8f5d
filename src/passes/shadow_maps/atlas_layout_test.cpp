#include "passes/shadow_maps/atlas_layout.h"

#include <gtest/gtest.h>

#include <vector>

namespace lightwell {
namespace {

glsl::ShadowView ask(std::uint32_t kind, std::uint32_t tile_side) {
  glsl::ShadowView view{};
  view.kind = kind;
  view.tile_side = tile_side;
  return view;
}

struct Rectangle {
  glm::uvec2 from, to;
};

std::vector<Rectangle> tiles(const std::vector<glsl::ShadowView>& views) {
  std::vector<Rectangle> all;
  for (const glsl::ShadowView& view : views) {
    for (std::uint32_t i = 0; i < count_views(view); ++i) {
      const glm::uvec2 from = view.tile + view.tile_side * glm::uvec2(i % 3, i / 3);
      all.push_back({from, from + view.tile_side});
    }
  }
  return all;
}

void expect_sound(const AtlasLayout& layout, const std::vector<glsl::ShadowView>& views, std::uint32_t atlas_side) {
  EXPECT_LE(layout.width, atlas_side);
  EXPECT_LE(layout.height, atlas_side);
  const std::vector<Rectangle> all = tiles(views);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_GE(all[i].to.x - all[i].from.x, kMinimumTileSide);
    EXPECT_LE(all[i].to.x, layout.width);
    EXPECT_LE(all[i].to.y, layout.height);
    for (std::size_t j = 0; j < i; ++j) {
      const bool apart = all[i].from.x >= all[j].to.x || all[j].from.x >= all[i].to.x || all[i].from.y >= all[j].to.y ||
                         all[j].from.y >= all[i].to.y;
      ASSERT_TRUE(apart) << "tiles " << i << " and " << j << " overlap";
    }
  }
}

TEST(AtlasLayout, TilesFitAndNeverOverlap) {
  std::vector<glsl::ShadowView> views{ask(glsl::kShadowOrthographic, 2048), ask(glsl::kShadowPerspective, 512),
                                      ask(glsl::kShadowCube, 512),          ask(glsl::kShadowNone, 0),
                                      ask(glsl::kShadowOrthographic, 2048), ask(glsl::kShadowCube, 512)};
  const AtlasLayout layout = lay_out_atlas(views, kMaximumAtlasSide);
  expect_sound(layout, views, kMaximumAtlasSide);
  EXPECT_EQ(tiles(views).size(), 15u);
  EXPECT_EQ(layout.shrunk, 1u);
  EXPECT_EQ(views[0].tile_side, 2048u);
  EXPECT_EQ(views[2].tile_side, 512u);

  std::vector<glsl::ShadowView> none;
  expect_sound(lay_out_atlas(none, kMaximumAtlasSide), none, kMaximumAtlasSide);
}

TEST(AtlasLayout, ManyLightsShareTheAtlasInSmallerTiles) {
  std::vector<glsl::ShadowView> views(500, ask(glsl::kShadowCube, 1024));
  views.push_back(ask(glsl::kShadowOrthographic, 4096));
  const AtlasLayout layout = lay_out_atlas(views, kMaximumAtlasSide);
  expect_sound(layout, views, kMaximumAtlasSide);
  EXPECT_EQ(tiles(views).size(), 3001u);
  EXPECT_EQ(layout.lights_left_out, 0u);
  EXPECT_EQ(views[0].tile_side, 1024u / layout.shrunk);
  EXPECT_EQ(views[500].tile_side, 4096u / layout.shrunk);
}

// What the device offers bounds the atlas, whatever is asked for.
TEST(AtlasLayout, SmallAtlasesHoldEveryKindOfView) {
  for (const std::uint32_t kind : {glsl::kShadowPerspective, glsl::kShadowCube, glsl::kShadowOrthographic}) {
    for (const std::uint32_t side : {128u, 1024u, 4096u}) {
      std::vector<glsl::ShadowView> views(2, ask(kind, 32768));
      const AtlasLayout layout = lay_out_atlas(views, side);
      expect_sound(layout, views, side);
      EXPECT_GT(layout.shrunk, 1u);
    }
  }
}

TEST(AtlasLayout, LightsBeyondTheSmallestTilesCastNoShadows) {
  std::vector<glsl::ShadowView> views(3000, ask(glsl::kShadowCube, 1024));
  const AtlasLayout layout = lay_out_atlas(views, 4096);
  EXPECT_LE(layout.width, 4096u);
  EXPECT_LE(layout.height, 4096u);
  EXPECT_EQ(views.front().kind, glsl::kShadowCube);
  EXPECT_EQ(views.front().tile_side, kMinimumTileSide);
  EXPECT_EQ(views.back().kind, glsl::kShadowNone);
  EXPECT_EQ(tiles(views).size(), 6 * (3000 - layout.lights_left_out));
}

}  // namespace
}  // namespace lightwell
