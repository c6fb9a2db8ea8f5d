#include "passes/gpu_scene/texture_buckets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightwell/error.h"
#include "lightwell/metrics.h"
#include "passes/gpu_scene/gpu_scene_types.h"

namespace lightwell {
namespace {

// A scene whose materials use the given textures as base colour.
Scene scene_with(std::vector<Texture> textures, AlphaMode alpha = AlphaMode::kOpaque) {
  Scene scene;
  for (Texture& texture : textures) {
    Material material;
    material.base_color_texture.texture = static_cast<int>(scene.textures.size());
    material.alpha_mode = alpha;
    scene.materials.push_back(material);
    scene.textures.push_back(std::move(texture));
  }
  return scene;
}

template <class Color>
Texture make_texture(int width, int height, const Color& color) {
  Texture texture;
  texture.width = width;
  texture.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const int value : color(x, y)) texture.rgba.push_back(static_cast<std::uint8_t>(value));
    }
  }
  return texture;
}

using Rgba = std::array<int, 4>;

const std::uint8_t* texel(const TextureBucket& bucket, std::uint32_t mip, std::uint32_t layer, std::uint32_t x,
                          std::uint32_t y) {
  std::size_t offset = 0;
  std::size_t side = bucket.side;
  for (std::uint32_t i = 0; i < mip; ++i, side /= 2) offset += side * side * 4 * bucket.layers;
  return &bucket.texels[offset + 4 * (side * side * layer + side * y + x)];
}

TextureBuckets build(const Scene& scene) {
  return build_texture_buckets(scene, 65536);
}

TEST(TextureBuckets, ChoosesTheNextSide) {
  const auto grey = [](int, int) { return Rgba{128, 128, 128, 255}; };
  const TextureBuckets result =
      build(scene_with({make_texture(128, 16, grey), make_texture(129, 16, grey), make_texture(8, 1024, grey),
                        make_texture(3000, 8, grey), make_texture(4, 4, grey)}));
  EXPECT_EQ(result.slots, (std::vector<std::uint32_t>{0x00000, 0x10000, 0x20000, 0x30000, 0x00001}));
  EXPECT_EQ(result.buckets[0].layers, 2u);
  EXPECT_EQ(result.buckets[0].mips, 8u);
  // One colour stays that colour at every size and in every mip.
  for (const TextureBucket& bucket : result.buckets) {
    for (std::size_t i = 0; i < bucket.texels.size(); ++i) ASSERT_EQ(bucket.texels[i], i % 4 == 3 ? 255 : 128);
  }
}

TEST(TextureBuckets, MoreLayersThanTheDeviceHasAreInputErrors) {
  const Texture grey = make_texture(1, 1, [](int, int) { return Rgba{128, 128, 128, 255}; });
  const Scene scene = scene_with({grey, grey, grey});
  EXPECT_EQ(build_texture_buckets(scene, 3).buckets[0].layers, 3u);
  EXPECT_THROW(build_texture_buckets(scene, 2), InputError);
}

TEST(TextureBuckets, LeavesOutWhatNoMaterialShows) {
  Scene scene = scene_with({make_texture(8, 8, [](int, int) { return Rgba{1, 2, 3, 4}; })});
  scene.materials[0].metallic_roughness_texture = scene.materials[0].base_color_texture;
  scene.materials[0].base_color_texture = {};
  const TextureBuckets result = build(scene);
  EXPECT_EQ(result.slots[0], glsl::kNoTexture);
  EXPECT_EQ(result.buckets[0].layers, 0u);
}

TEST(TextureBuckets, KeepsTexelsOfTheRightSize) {
  const auto pattern = [](int x, int y) { return Rgba{x, y, (x * y) % 256, 255 - x}; };
  const TextureBuckets result = build(scene_with({make_texture(128, 128, pattern)}));
  for (std::uint32_t y = 0; y < 128; ++y) {
    for (std::uint32_t x = 0; x < 128; ++x) {
      const Rgba expected = pattern(static_cast<int>(x), static_cast<int>(y));
      for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(texel(result.buckets[0], 0, 0, x, y)[c], expected[c]);
    }
  }
}

TEST(TextureBuckets, AveragesLightNotCodes) {
  const auto stripes = [](int x, int) { return x % 2 == 0 ? Rgba{0, 0, 0, 255} : Rgba{255, 255, 255, 255}; };
  const TextureBuckets result = build(scene_with({make_texture(128, 128, stripes)}));
  const auto half = static_cast<int>(std::lround(255.0f * srgb_encode(0.5f)));
  for (std::uint32_t mip = 1; mip < 8; ++mip) EXPECT_EQ(texel(result.buckets[0], mip, 0, 0, 0)[0], half);
}

TEST(TextureBuckets, NearestTexturesGrowWithoutMixing) {
  Texture texture = make_texture(16, 16, [](int x, int y) {
    return (x + y) % 2 == 0 ? Rgba{255, 0, 0, 255} : Rgba{0, 0, 255, 255};
  });
  texture.nearest = true;
  const TextureBuckets result = build(scene_with({texture}));
  for (std::uint32_t x = 0; x < 128; ++x) {
    EXPECT_EQ(texel(result.buckets[0], 0, 0, x, 0)[0], (x / 8) % 2 == 0 ? 255 : 0);
  }
}

TEST(TextureBuckets, HolesKeepTheirShareInEveryMip) {
  // Dots of one texel in four of each row and column: alpha would average to 16 and vanish.
  const auto dots = [](int x, int y) { return Rgba{0, 255, 0, x % 4 == 0 && y % 4 == 0 ? 255 : 0}; };
  const TextureBuckets result = build(scene_with({make_texture(128, 128, dots)}, AlphaMode::kMask));
  int covered = 0;
  for (std::uint32_t y = 0; y < 64; ++y) {
    for (std::uint32_t x = 0; x < 64; ++x) {
      const std::uint8_t* rgba = texel(result.buckets[0], 1, 0, x, y);
      covered += rgba[3] >= 128 ? 1 : 0;
      EXPECT_GE(rgba[1], 250);  // what is cut away leaves no fringe
    }
  }
  EXPECT_GE(covered, 64 * 64 / 16);
}

}  // namespace
}  // namespace lightwell
