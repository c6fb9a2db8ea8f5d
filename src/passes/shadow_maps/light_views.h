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
  std::uint32_t tile_side = 1;  // texels
  std::uint32_t columns = 1;    // of tiles
  std::uint32_t rows = 1;
  std::uint32_t view_count = 0;
};

inline constexpr std::uint32_t kMaximumAtlasSide = 8192;
inline constexpr std::uint32_t kMinimumTileSide = 64;

// `bounds` holds everything that casts shadows; `focus` what directional lights' shadow maps must cover (spending texels
// on a kilometre of ground round a house would leave none for the house). Tiles have `tile_side` texels, or fewer where
// the views would not fit in the atlas; lights beyond what fits with the smallest tiles cast no shadows.
LightViews make_light_views(std::span<const WorldLight> lights, const Bounds& bounds, const Bounds& focus,
                            std::uint32_t tile_side);

}  // namespace lightwell
