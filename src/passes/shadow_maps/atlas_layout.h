// Where the shadow maps of all lights lie in their atlas.
#pragma once

#include <cstdint>
#include <span>

#include "shaders/shadow_view.h"

namespace lightwell {

inline constexpr std::uint32_t kMaximumAtlasSide = 8192;  // texels: 256 MiB, which no option raises
inline constexpr std::uint32_t kMinimumTileSide = 32;     // texels

struct AtlasLayout {
  std::uint32_t width = 1;  // texels
  std::uint32_t height = 1;
  std::uint32_t shrunk = 1;           // some tile has 1 / shrunk of the side that it asked for
  std::uint32_t lights_left_out = 0;  // they have no tiles and cast no shadows
};

// How many views a light has: they lie 3 in a row, from its tile on.
std::uint32_t count_views(const glsl::ShadowView& view);

// Texels that they take.
glm::uvec2 block_size(const glsl::ShadowView& view);

// Gives each light its tiles in the smallest atlas that holds all of them. `kind` and `tile_side` say what a light asks
// for; where an atlas of atlas_side x atlas_side texels would not hold that, all sides are halved together until it
// does, but not below kMinimumTileSide. `atlas_side` is a power of two, kMinimumTileSide * 4 at least. Lights beyond
// what fits even then become kShadowNone, the last ones first.
AtlasLayout lay_out_atlas(std::span<glsl::ShadowView> views, std::uint32_t atlas_side);

}  // namespace lightwell
