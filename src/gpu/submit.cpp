#include "gpu/submit.h"

#include "gpu/device.h"

namespace lightwell {

Submitter::Submitter(Device& device) : device_(device) {
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool.queueFamilyIndex = device.queue_family();
  LW_VK(device.vk().vkCreateCommandPool(device.handle(), &pool, nullptr, &pool_));
  VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocate.commandPool = pool_;
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  LW_VK(device.vk().vkAllocateCommandBuffers(device.handle(), &allocate, &commands_));
  const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  LW_VK(device.vk().vkCreateFence(device.handle(), &fence, nullptr, &fence_));
}

Submitter::~Submitter() {
  device_.vk().vkDestroyFence(device_.handle(), fence_, nullptr);
  device_.vk().vkDestroyCommandPool(device_.handle(), pool_, nullptr);
}

void Submitter::run(const std::function<void(VkCommandBuffer)>& record) {
  const auto& vk = device_.vk();
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  LW_VK(vk.vkBeginCommandBuffer(commands_, &begin));
  try {
    record(commands_);
  } catch (...) {
    vk.vkResetCommandBuffer(commands_, 0);  // half recorded: the next run could not begin
    throw;
  }
  LW_VK(vk.vkEndCommandBuffer(commands_));
  VkCommandBufferSubmitInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
  buffer.commandBuffer = commands_;
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.commandBufferInfoCount = 1;
  submit.pCommandBufferInfos = &buffer;
  LW_VK(vk.vkQueueSubmit2(device_.queue(), 1, &submit, fence_));
  LW_VK(vk.vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX));
  LW_VK(vk.vkResetFences(device_.handle(), 1, &fence_));
}

}  // namespace lightwell
