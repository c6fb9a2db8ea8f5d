// The fixed-function state that a raster pass chooses.
#pragma once

#include <compare>

#include "gpu/vulkan.h"

namespace lightwell {

struct RasterState {
  VkCullModeFlags cull = VK_CULL_MODE_NONE;
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkCompareOp depth_compare = VK_COMPARE_OP_LESS;
  bool depth_write = true;
  float depth_bias_constant = 0.0f;
  float depth_bias_slope = 0.0f;
  auto operator<=>(const RasterState&) const = default;
};

}  // namespace lightwell
