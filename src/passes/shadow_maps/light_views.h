// Where each light's shadow maps lie in the atlas, and how the light sees the world.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightwell/scene.h"
#include "shaders/lights.h"

namespace lightwell {

struct LightViews {
  std::vector<glsl::GpuLight> lights;
  std::uint32_t atlas_width = 1;  // texels
  std::uint32_t atlas_height = 1;
};

// How many views a light has: they lie 3 in a row, from its tile on.
std::uint32_t count_views(const glsl::GpuLight& light);

inline constexpr std::uint32_t kMaximumAtlasSide = 8192;
inline constexpr std::uint32_t kMinimumTileSide = 32;
inline constexpr std::uint32_t kDirectionalTileFactor = 4;  // one view of a sun covers what hundreds of lamps do

// `bounds` holds everything that casts shadows; `focus` what matters most of it: where it is much less, a
// directional light gets a second, finer view of it (a kilometre of ground round a house would leave the house no
// texels). A view has `tile_side` texels a side (directional lights: kDirectionalTileFactor times that), or fewer where
// the views would not fit in the atlas; lights beyond what fits with the smallest tiles cast no shadows, and with a
// `tile_side` of 0 none does.
LightViews make_light_views(std::span<const WorldLight> lights, const Bounds& bounds, const Bounds& focus,
                            std::uint32_t tile_side);

}  // namespace lightwell
