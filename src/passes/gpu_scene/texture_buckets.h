// Textures as the GPU wants them on the baseline device, which cannot choose among many images per pixel: square RGBA8
// layers of four 2D arrays, with mips. A texture is resampled to the nearest side that is not smaller (2048 at most).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lightwell/scene.h"

namespace lightwell {

inline constexpr std::array<std::uint32_t, 4> kTextureSides{128, 512, 1024, 2048};

struct TextureBucket {
  std::uint32_t side = 1;
  std::uint32_t layers = 0;
  std::uint32_t mips = 1;
  std::vector<std::uint8_t> texels;  // sRGB colour, linear alpha; mip by mip, each with all its layers
};

struct TextureBuckets {
  std::array<TextureBucket, 4> buckets;
  std::vector<std::uint32_t>
      slots;  // of each of the scene's textures: bucket * 65536 + layer; glsl::kNoTexture: not used
};

// Takes the textures that some material uses as base colour or emission. Mips are averaged in linear light; where a
// material cuts holes, each mip keeps the finest one's fraction of holes (Castano 2010), so that foliage does not thin
// out with distance. Runs on all cores. Throws InputError, before the work, if a bucket would need more than
// `most_layers` (65536 at most, as a slot holds no more).
TextureBuckets build_texture_buckets(const Scene& scene, std::uint32_t most_layers);

}  // namespace lightwell
