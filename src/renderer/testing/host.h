// A host that owns instance, device, queue, command buffers, fences and images, and lends them. For tests only.
#pragma once

#include <gtest/gtest.h>

#include <dlfcn.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "lightwell/device.h"
#include "renderer/test_scene.h"

namespace lightwell {

inline constexpr std::uint32_t kSide = 64;
inline constexpr std::uint32_t kFramesInFlight = 2;

inline VkBool32 VKAPI_PTR keep_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
  static_cast<std::vector<std::string>*>(messages)->push_back(data->pMessage);
  return VK_FALSE;
}

// The host's own Vulkan: nothing of it goes through Lightwell. `validation`: where the layer is installed.
class Host {
 public:
  explicit Host(bool validation = true) {
    library_ = dlopen("libvulkan.so.1", RTLD_NOW);
    if (library_ == nullptr) return;
    get_ = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library_, "vkGetInstanceProcAddr"));
    make_instance(validation);
    std::uint32_t count = 1;
    call<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices")(instance_, &count, &physical_device_);
    if (physical_device_ != VK_NULL_HANDLE) make_device();
  }

  ~Host() {
    if (device_ != VK_NULL_HANDLE) {
      call<PFN_vkDestroyCommandPool>("vkDestroyCommandPool")(device_, pool_, nullptr);
      call<PFN_vkDestroyDevice>("vkDestroyDevice")(device_, nullptr);
    }
    if (messenger_ != VK_NULL_HANDLE) {
      call<PFN_vkDestroyDebugUtilsMessengerEXT>("vkDestroyDebugUtilsMessengerEXT")(instance_, messenger_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) call<PFN_vkDestroyInstance>("vkDestroyInstance")(instance_, nullptr);
    if (library_ != nullptr) dlclose(library_);
  }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  bool works() const { return device_ != VK_NULL_HANDLE; }
  const std::vector<std::string>& messages() const { return messages_; }
  VkDevice device() const { return device_; }
  VkQueue queue() const { return queue_; }
  VkCommandPool pool() const { return pool_; }
  HostDevice lend() const { return {get_, instance_, physical_device_, device_, 0, queue_, ray_query_}; }

  template <class Function>
  Function call(const char* name) const {
    return reinterpret_cast<Function>(get_(instance_, name));
  }

  // A memory type with these properties.
  std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags properties) const {
    VkPhysicalDeviceMemoryProperties memory;
    call<PFN_vkGetPhysicalDeviceMemoryProperties>("vkGetPhysicalDeviceMemoryProperties")(physical_device_, &memory);
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      if ((allowed >> i & 1) != 0 && (memory.memoryTypes[i].propertyFlags & properties) == properties) return i;
    }
    return 0;
  }

 private:
  void make_instance(bool validation) {
    const char* layer = "VK_LAYER_KHRONOS_validation";
    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
    const auto create = call<PFN_vkCreateInstance>("vkCreateInstance");
    if (!validation || create(&info, nullptr, &instance_) != VK_SUCCESS) {
      info.pNext = nullptr;
      info.enabledLayerCount = 0;
      info.enabledExtensionCount = 0;
      create(&info, nullptr, &instance_);
      return;
    }
    VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = keep_message;
    messenger.pUserData = &messages_;
    call<PFN_vkCreateDebugUtilsMessengerEXT>("vkCreateDebugUtilsMessengerEXT")(instance_, &messenger, nullptr,
                                                                               &messenger_);
  }

  void make_device() {
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    ray_query_ = offers_ray_query(get_, instance_, physical_device_);
    const RequiredFeatures required(ray_query_);
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = &required.features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<std::uint32_t>(required.extensions.size());
    info.ppEnabledExtensionNames = required.extensions.data();
    if (call<PFN_vkCreateDevice>("vkCreateDevice")(physical_device_, &info, nullptr, &device_) != VK_SUCCESS) return;
    call<PFN_vkGetDeviceQueue>("vkGetDeviceQueue")(device_, 0, 0, &queue_);
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    call<PFN_vkCreateCommandPool>("vkCreateCommandPool")(device_, &pool, nullptr, &pool_);
  }

  void* library_ = nullptr;
  PFN_vkGetInstanceProcAddr get_ = nullptr;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  bool ray_query_ = false;
  std::vector<std::string> messages_;
};

// What the host keeps for one frame in flight: command buffer, fence, its image, and a buffer to look at it.
class HostFrame {
 public:
  explicit HostFrame(const Host& host) : host_(host) {
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = host.pool();
    allocate.commandBufferCount = 1;
    host.call<PFN_vkAllocateCommandBuffers>("vkAllocateCommandBuffers")(host.device(), &allocate, &commands);
    VkFenceCreateInfo fence_info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    fence_info.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    host.call<PFN_vkCreateFence>("vkCreateFence")(host.device(), &fence_info, nullptr, &fence);
    make_image();
    make_buffer();
  }

  ~HostFrame() {
    host_.call<PFN_vkFreeCommandBuffers>("vkFreeCommandBuffers")(host_.device(), host_.pool(), 1, &commands);
    host_.call<PFN_vkDestroyFence>("vkDestroyFence")(host_.device(), fence, nullptr);
    host_.call<PFN_vkDestroyImage>("vkDestroyImage")(host_.device(), image, nullptr);
    host_.call<PFN_vkDestroyBuffer>("vkDestroyBuffer")(host_.device(), buffer_, nullptr);
    for (const VkDeviceMemory memory : memory_) {
      host_.call<PFN_vkFreeMemory>("vkFreeMemory")(host_.device(), memory, nullptr);
    }
  }
  HostFrame(const HostFrame&) = delete;
  HostFrame& operator=(const HostFrame&) = delete;

  void wait() { host_.call<PFN_vkWaitForFences>("vkWaitForFences")(host_.device(), 1, &fence, VK_TRUE, UINT64_MAX); }

  void begin() {
    wait();
    host_.call<PFN_vkResetFences>("vkResetFences")(host_.device(), 1, &fence);
    VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    host_.call<PFN_vkBeginCommandBuffer>("vkBeginCommandBuffer")(commands, &info);
  }

  // Copies the image, which Lightwell left ready for that, and submits.
  void end() {
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {kSide, kSide, 1};
    host_.call<PFN_vkCmdCopyImageToBuffer>("vkCmdCopyImageToBuffer")(
        commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer_, 1, &region);
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    host_.call<PFN_vkCmdPipelineBarrier>("vkCmdPipelineBarrier")(
        commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
    host_.call<PFN_vkEndCommandBuffer>("vkEndCommandBuffer")(commands);
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    host_.call<PFN_vkQueueSubmit>("vkQueueSubmit")(host_.queue(), 1, &submit, fence);
  }

  const std::uint8_t* texel(int x, int y) const { return pixels_ + 4 * (y * static_cast<int>(kSide) + x); }

  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  VkImage image = VK_NULL_HANDLE;
  std::uint64_t number = 0;  // that Lightwell gave the frame recorded last

 private:
  void make_image() {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_B8G8R8A8_UNORM;
    info.extent = {kSide, kSide, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    host_.call<PFN_vkCreateImage>("vkCreateImage")(host_.device(), &info, nullptr, &image);
    VkMemoryRequirements needs;
    host_.call<PFN_vkGetImageMemoryRequirements>("vkGetImageMemoryRequirements")(host_.device(), image, &needs);
    host_.call<PFN_vkBindImageMemory>("vkBindImageMemory")(host_.device(), image, allocate(needs, 0), 0);
  }

  void make_buffer() {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = 4 * kSide * kSide;
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    host_.call<PFN_vkCreateBuffer>("vkCreateBuffer")(host_.device(), &info, nullptr, &buffer_);
    VkMemoryRequirements needs;
    host_.call<PFN_vkGetBufferMemoryRequirements>("vkGetBufferMemoryRequirements")(host_.device(), buffer_, &needs);
    const VkDeviceMemory memory =
        allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    host_.call<PFN_vkBindBufferMemory>("vkBindBufferMemory")(host_.device(), buffer_, memory, 0);
    void* mapped = nullptr;
    host_.call<PFN_vkMapMemory>("vkMapMemory")(host_.device(), memory, 0, VK_WHOLE_SIZE, 0, &mapped);
    pixels_ = static_cast<const std::uint8_t*>(mapped);
  }

  VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties) {
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = needs.size;
    info.memoryTypeIndex = host_.memory_type(needs.memoryTypeBits, properties);
    host_.call<PFN_vkAllocateMemory>("vkAllocateMemory")(host_.device(), &info, nullptr, &memory_.emplace_back());
    return memory_.back();
  }

  const Host& host_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  const std::uint8_t* pixels_ = nullptr;
  std::vector<VkDeviceMemory> memory_;
};

inline TestScene make_scene() {
  TestScene test;
  test.add_wall(test.add_material({0.9f, 0.5f, 0.1f}));
  test.add_quad({-0.2f, -0.2f, 0.4f}, {0.4f, 0, 0}, {0, 0.4f, 0}, test.add_material({0.2f, 0.4f, 0.8f}));
  return test;
}

inline void expect_same_picture(const HostFrame& frame, const Image& expected) {
  int differ = 0;
  for (int y = 0; y < expected.height; ++y) {
    for (int x = 0; x < expected.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const int value = frame.texel(x, y)[2 - c];  // BGRA
        differ += std::abs(value - 255.0f * expected.at(x, y)[c]) > 1.0f ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(differ, 0);
}

}  // namespace lightwell
