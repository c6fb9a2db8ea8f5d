// How a resource was used last: enough to order the next use after it.
#pragma once

#include <vector>

#include "gpu/vulkan.h"

namespace lightwell {

struct ResourceState {
  VkPipelineStageFlags2 write_stages = 0;  // of the last write
  VkAccessFlags2 write_access = 0;
  VkPipelineStageFlags2 read_stages = 0;  // of the reads since then; they already see that write
  VkAccessFlags2 read_access = 0;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  bool operator==(const ResourceState&) const = default;
};

// Of an image's mips and layers.
struct ImageState {
  ResourceState whole;               // of all of them, as long as they are alike
  std::vector<ResourceState> parts;  // otherwise: mip by mip, all layers of each
};

}  // namespace lightwell
