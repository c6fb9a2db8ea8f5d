// The inside of lightwell/device.h.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/deferred_destruction.h"
#include "gpu/device_table.h"
#include "gpu/memory.h"
#include "gpu/vulkan.h"
#include "lightwell/device.h"

namespace lightwell {

// Instance-level functions that we call.
struct InstanceTable {
  PFN_vkDestroyInstance vkDestroyInstance = nullptr;
  PFN_vkEnumeratePhysicalDevices vkEnumeratePhysicalDevices = nullptr;
  PFN_vkGetPhysicalDeviceProperties2 vkGetPhysicalDeviceProperties2 = nullptr;
  PFN_vkGetPhysicalDeviceFeatures2 vkGetPhysicalDeviceFeatures2 = nullptr;
  PFN_vkGetPhysicalDeviceMemoryProperties vkGetPhysicalDeviceMemoryProperties = nullptr;
  PFN_vkGetPhysicalDeviceFormatProperties vkGetPhysicalDeviceFormatProperties = nullptr;
  PFN_vkGetPhysicalDeviceQueueFamilyProperties vkGetPhysicalDeviceQueueFamilyProperties = nullptr;
  PFN_vkEnumerateDeviceExtensionProperties vkEnumerateDeviceExtensionProperties = nullptr;
  PFN_vkCreateDevice vkCreateDevice = nullptr;
  PFN_vkGetDeviceProcAddr vkGetDeviceProcAddr = nullptr;
  PFN_vkCreateDebugUtilsMessengerEXT vkCreateDebugUtilsMessengerEXT = nullptr;
  PFN_vkDestroyDebugUtilsMessengerEXT vkDestroyDebugUtilsMessengerEXT = nullptr;
  PFN_vkCmdBeginDebugUtilsLabelEXT vkCmdBeginDebugUtilsLabelEXT = nullptr;
  PFN_vkCmdEndDebugUtilsLabelEXT vkCmdEndDebugUtilsLabelEXT = nullptr;
  PFN_vkSetDebugUtilsObjectNameEXT vkSetDebugUtilsObjectNameEXT = nullptr;

  InstanceTable() = default;
  InstanceTable(PFN_vkGetInstanceProcAddr get, VkInstance instance);
};

class PipelineCache;

class Device {
 public:
  // Throws InputError naming the device option: no Vulkan loader, no such device, or features missing (all named).
  explicit Device(const DeviceOptions& options = {});
  explicit Device(const HostDevice& host);
  ~Device();  // whatever recorded frames with it is gone; a lent device is not touched otherwise
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceTable& vk() const { return vk_; }
  const InstanceTable& instance_table() const { return instance_table_; }
  VkInstance instance() const { return instance_; }
  VkDevice handle() const { return device_; }
  VkPhysicalDevice physical_device() const { return physical_device_; }
  VkQueue queue() const { return queue_; }
  std::uint32_t queue_family() const { return queue_family_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  const DeviceSummary& summary() const { return summary_; }
  const std::string& choice_reason() const { return choice_reason_; }  // why this device was chosen
  bool is_lent() const { return !owned_; }                             // by a host, who alone submits to the queue
  bool has_timestamps() const { return timestamp_bits_ > 0; }
  std::uint64_t timestamp_mask() const;
  // Bytes: of one buffer at most, and what a storage buffer's descriptor reaches of it.
  std::uint64_t largest_buffer() const { return largest_buffer_; }
  std::uint64_t descriptor_range() const { return descriptor_range_; }
  // As if descriptors reached no further: tests of paged buffers call it before they make anything of the device.
  void limit_descriptor_range(std::uint64_t bytes) { descriptor_range_ = bytes; }
  // Ray queries and acceleration structures can be used, and buffers have addresses.
  bool has_ray_query() const { return ray_query_; }
  std::uint32_t scratch_alignment() const { return scratch_alignment_; }  // of addresses for builds

  // What passes/trace/choose_tracing.h measured: whether ray queries are the faster way to trace here.
  std::optional<bool> prefers_ray_query;

  MemoryPool& memory() { return *memory_; }
  PipelineCache& pipelines() { return *pipelines_; }
  VkSampler sampler(std::uint8_t kind);  // a SamplerKind

  // Usages that images of this format get: all that the device allows and the graph can ask for.
  VkImageUsageFlags usages(VkFormat format) const;

  DeferredDestruction& deferred() { return deferred_; }

  void set_name(VkObjectType type, std::uint64_t handle, std::string_view name);

  bool has_validation() const { return messenger_ != VK_NULL_HANDLE; }
  // Validation messages so far (of a device with validation on), each on one line.
  const std::vector<std::string>& validation_messages() const { return *messages_; }

 private:
  void create_instance(PFN_vkGetInstanceProcAddr get, bool validation);
  void choose_physical_device(const std::string& wanted);
  void create_device();
  void finish_setup();

  std::unique_ptr<std::vector<std::string>> messages_ = std::make_unique<std::vector<std::string>>();
  bool owned_ = true;
  bool debug_utils_ = false;
  bool ray_query_ = false;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::uint32_t queue_family_ = 0;
  std::uint32_t timestamp_bits_ = 0;
  std::uint32_t scratch_alignment_ = 1;
  VkPhysicalDeviceLimits limits_{};
  std::uint64_t largest_buffer_ = 0;
  std::uint64_t descriptor_range_ = 0;
  InstanceTable instance_table_;
  DeviceTable vk_{};
  DeviceSummary summary_;
  std::string choice_reason_;
  std::unique_ptr<MemoryPool> memory_;
  std::unique_ptr<PipelineCache> pipelines_;
  std::vector<VkSampler> samplers_;
  DeferredDestruction deferred_;
};

}  // namespace lightwell
