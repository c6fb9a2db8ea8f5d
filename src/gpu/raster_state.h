// The fixed-function state that a raster pass chooses: triangles, never culled, depth written.
#pragma once

#include <compare>
#include <cstdint>

#include "gpu/vulkan.h"

namespace lightwell {

enum class Blend : std::uint8_t {
  kReplace,
  kAdd  // to what is there, all four channels
};

struct RasterState {
  VkCompareOp depth_compare = VK_COMPARE_OP_LESS;
  Blend blend = Blend::kReplace;
  auto operator<=>(const RasterState&) const = default;
};

}  // namespace lightwell
