// Device-level functions that we call, of one device: nothing of Vulkan's loader is global.
#pragma once

#include "gpu/vulkan.h"

namespace lightwell {

// clang-format off
#define LW_DEVICE_FUNCTIONS(X) \
  X(vkAllocateCommandBuffers) X(vkAllocateDescriptorSets) X(vkAllocateMemory) X(vkBeginCommandBuffer) \
  X(vkBindBufferMemory) X(vkBindImageMemory) X(vkCmdBeginRendering) X(vkCmdBindDescriptorSets) \
  X(vkCmdBindIndexBuffer) X(vkCmdBindPipeline) X(vkCmdBuildAccelerationStructuresKHR) X(vkCmdCopyBuffer) \
  X(vkCmdCopyBufferToImage) X(vkCmdCopyImageToBuffer) X(vkCmdDispatch) X(vkCmdDispatchIndirect) X(vkCmdDraw) \
  X(vkCmdDrawIndexed) X(vkCmdDrawIndexedIndirect) X(vkCmdDrawIndirect) X(vkCmdEndRendering) X(vkCmdFillBuffer) \
  X(vkCmdPipelineBarrier2) X(vkCmdPushConstants) X(vkCmdResetQueryPool) X(vkCmdSetScissor) X(vkCmdSetViewport) \
  X(vkCmdWriteTimestamp2) X(vkCreateAccelerationStructureKHR) X(vkCreateBuffer) X(vkCreateCommandPool) \
  X(vkCreateComputePipelines) X(vkCreateDescriptorPool) X(vkCreateDescriptorSetLayout) X(vkCreateFence) \
  X(vkCreateGraphicsPipelines) X(vkCreateImage) X(vkCreateImageView) X(vkCreatePipelineCache) \
  X(vkCreatePipelineLayout) X(vkCreateQueryPool) X(vkCreateSampler) X(vkCreateShaderModule) \
  X(vkDestroyAccelerationStructureKHR) X(vkDestroyBuffer) X(vkDestroyCommandPool) X(vkDestroyDescriptorPool) \
  X(vkDestroyDescriptorSetLayout) X(vkDestroyDevice) X(vkDestroyFence) X(vkDestroyImage) X(vkDestroyImageView) \
  X(vkDestroyPipeline) X(vkDestroyPipelineCache) X(vkDestroyPipelineLayout) X(vkDestroyQueryPool) \
  X(vkDestroySampler) X(vkDestroyShaderModule) X(vkEndCommandBuffer) X(vkFreeMemory) \
  X(vkGetAccelerationStructureBuildSizesKHR) X(vkGetAccelerationStructureDeviceAddressKHR) \
  X(vkGetBufferDeviceAddress) X(vkGetBufferMemoryRequirements) X(vkGetDeviceQueue) X(vkGetImageMemoryRequirements) \
  X(vkGetPipelineCacheData) X(vkGetQueryPoolResults) X(vkMapMemory) X(vkQueueSubmit2) X(vkResetCommandBuffer) \
  X(vkResetDescriptorPool) X(vkResetFences) X(vkUpdateDescriptorSets) X(vkWaitForFences)
// clang-format on

// Those of extensions that the device was made without are null.
struct DeviceTable {
#define LW_MEMBER(name) PFN_##name name = nullptr;
  LW_DEVICE_FUNCTIONS(LW_MEMBER)
#undef LW_MEMBER

  DeviceTable() = default;
  DeviceTable(PFN_vkGetDeviceProcAddr get, VkDevice device) {
#define LW_LOAD(name) name = reinterpret_cast<PFN_##name>(get(device, #name));
    LW_DEVICE_FUNCTIONS(LW_LOAD)
#undef LW_LOAD
  }
};

}  // namespace lightwell
