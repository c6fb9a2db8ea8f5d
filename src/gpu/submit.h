// Runs command buffers to their end: for tools and tests that own no frame loop.
#pragma once

#include <cstdint>
#include <functional>

#include "gpu/vulkan.h"

namespace lightwell {

class Device;

// One command pool, buffer and fence, used again and again. Throws InputError if the GPU does not finish.
class Submitter {
 public:
  explicit Submitter(Device& device);
  ~Submitter();
  Submitter(const Submitter&) = delete;
  Submitter& operator=(const Submitter&) = delete;

  // Records with `record`, submits, waits. Where `record` throws, nothing is submitted, and it can run again.
  void run(const std::function<void(VkCommandBuffer)>& record);

 private:
  Device& device_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
};

}  // namespace lightwell
