// From a declared frame to what must happen: which passes run, which physical resource serves each transient, and which
// barriers stand before each pass. Pure functions of plain data, tested without a device.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/resource_state.h"
#include "graph/frame_graph.h"

namespace lightwell {

struct Barrier {
  bool is_image = false;
  std::uint32_t index = 0;  // in FrameGraph::buffers() or images()
  Subresource part;         // of an image
  VkPipelineStageFlags2 from_stages = 0;
  VkAccessFlags2 from_access = 0;
  VkPipelineStageFlags2 to_stages = 0;
  VkAccessFlags2 to_access = 0;
  VkImageLayout from_layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImageLayout to_layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

struct UseInfo {
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  bool writes = false;
};

UseInfo describe_use(const ResourceUse& use);

// Moves `state` to the new use. True if a barrier (filled in but for index) must stand before it.
bool advance(ResourceState& state, const UseInfo& use, bool is_image, Barrier& barrier);

// Moves the mips and layers that `part` names to the new use; appends the barriers that must stand before it.
void advance(ImageState& state, const ImageDesc& desc, const UseInfo& use, Subresource part,
             std::vector<Barrier>& barriers);

struct Plan {
  std::vector<bool> is_alive;  // one a pass: it leads to a root, so it runs
  // For every transient of the graph, the pool slot that it lives in; UINT32_MAX for resources of other lifetimes and
  // for those that no pass that runs uses. Two transients share a slot only if their descriptions are equal and every
  // use of one comes before every use of the other.
  std::vector<std::uint32_t> buffer_slots;
  std::vector<std::uint32_t> image_slots;
  std::vector<BufferDesc> buffer_pool;  // by slot
  std::vector<ImageDesc> image_pool;
  std::vector<std::vector<ResourceUse>> pass_uses;  // uses of one resource in one pass merged; one a pass
};

// Asserts that every transient is written before it is read.
Plan make_plan(const FrameGraph& graph);

}  // namespace lightwell
