// The fixed-function state that a raster pass chooses: triangles, never culled, depth written.
#pragma once

#include <compare>

#include "gpu/vulkan.h"

namespace lightwell {

struct RasterState {
  VkCompareOp depth_compare = VK_COMPARE_OP_LESS;
  auto operator<=>(const RasterState&) const = default;
};

}  // namespace lightwell
