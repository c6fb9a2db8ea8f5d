// The GPU device: our own, or one that a host application lends.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lightwell/vulkan.h"

namespace lightwell {

struct DeviceOptions {
  // "" or "best": discrete before integrated before virtual before software. "cpu": a software device. Otherwise a
  // part of a device's name (case does not matter) or its index in list_devices().
  std::string device;
  // Core and synchronisation validation, every message counted and kept; new buffers are filled with NaN.
  bool validation = false;
};

struct DeviceSummary {
  std::string name;
  std::string driver;                // name and version
  std::string type;                  // "discrete GPU", "software", ...
  std::vector<std::string> missing;  // required features that it lacks; empty: usable
  bool ray_query = false;            // it has ray queries (never required)
};

// All Vulkan devices of this machine, best first. Empty if there is no Vulkan at all.
std::vector<DeviceSummary> list_devices();

// What a host application lends: it owns all of it and outlives the Device. The features of RequiredFeatures must have
// been enabled. The queue does graphics and compute; only the host submits to it while it records frames.
struct HostDevice {
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  VkQueue queue = VK_NULL_HANDLE;
  bool ray_query = false;  // the device was made with RequiredFeatures(true)
};

// Whether the device has ray queries: then RequiredFeatures(true) can be enabled, and Lightwell may use them.
bool offers_ray_query(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance, VkPhysicalDevice device);

// The features that Lightwell turns on, for hosts that make their own device: chain `features` into VkDeviceCreateInfo
// and enable `extensions`. Ray queries are not required; with them come bufferDeviceAddress and acceleration
// structures.
struct RequiredFeatures {
  VkPhysicalDeviceRayQueryFeaturesKHR ray_queries{};
  VkPhysicalDeviceAccelerationStructureFeaturesKHR acceleration_structures{};
  VkPhysicalDeviceVulkan13Features features13{};
  VkPhysicalDeviceVulkan12Features features12{};
  VkPhysicalDeviceFeatures2 features{};
  std::vector<const char*> extensions;  // none without ray queries
  explicit RequiredFeatures(bool ray_query = false);
  RequiredFeatures(const RequiredFeatures&) = delete;
};

class Device;
struct DeviceDeleter {
  void operator()(Device* device) const;
};
using DevicePtr = std::unique_ptr<Device, DeviceDeleter>;

// Throw InputError: no Vulkan loader, no such device, or features missing (all of them named).
DevicePtr open_device(const DeviceOptions& options = {});
DevicePtr wrap_device(const HostDevice& host);

}  // namespace lightwell
