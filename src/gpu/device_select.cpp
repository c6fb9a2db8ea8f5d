#include "gpu/device_select.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "core/join.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

// A kernel has up to seven buffers in four pages each, and two more (shaders/paged_buffer.glsl).
constexpr std::uint32_t kStorageBuffersPerStage = 30;
constexpr std::uint32_t kColorAttachments = 6;  // of the G-buffer; 8 everywhere that we know of

const char* type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "software";
    default:
      return "other";
  }
}

int rank(VkPhysicalDeviceType type) {
  constexpr std::array kOrder = {VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
                                 VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_OTHER,
                                 VK_PHYSICAL_DEVICE_TYPE_CPU};
  return static_cast<int>(std::find(kOrder.begin(), kOrder.end(), type) - kOrder.begin());
}

std::string version_text(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::vector<std::string> find_missing(const InstanceTable& table, VkPhysicalDevice device,
                                      const VkPhysicalDeviceProperties& properties) {
  if (properties.apiVersion < VK_API_VERSION_1_3)
    return {"Vulkan 1.3 (it has " + version_text(properties.apiVersion) + ")"};
  std::vector<std::string> missing;
  VkPhysicalDeviceVulkan13Features features13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &features13};
  table.vkGetPhysicalDeviceFeatures2(device, &features);
  const auto need = [&](bool has, const char* name) {
    if (!has) missing.emplace_back(name);
  };
  need(features13.dynamicRendering, "dynamicRendering");
  need(features13.synchronization2, "synchronization2");
  need(features.features.robustBufferAccess, "robustBufferAccess");
  need(features.features.fragmentStoresAndAtomics, "fragmentStoresAndAtomics");
  need(properties.limits.maxPerStageDescriptorStorageBuffers >= kStorageBuffersPerStage, "30 storage buffers a stage");
  need(properties.limits.maxColorAttachments >= kColorAttachments, "6 color attachments");
  std::uint32_t count = 0;
  table.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  table.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  constexpr VkQueueFlags kWanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  need(std::any_of(families.begin(), families.end(),
                   [](const VkQueueFamilyProperties& f) { return (f.queueFlags & kWanted) == kWanted; }),
       "a queue with graphics and compute");
  return missing;
}

bool has_ray_query(const InstanceTable& table, VkPhysicalDevice device) {
  std::uint32_t count = 0;
  LW_VK(table.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr));
  std::vector<VkExtensionProperties> extensions(count);
  LW_VK(table.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()));
  RequiredFeatures offered(true);
  for (const std::string_view wanted : offered.extensions)
    if (std::none_of(extensions.begin(), extensions.end(),
                     [&](const VkExtensionProperties& e) { return e.extensionName == wanted; }))
      return false;
  table.vkGetPhysicalDeviceFeatures2(device, &offered.features);
  return offered.ray_queries.rayQuery && offered.acceleration_structures.accelerationStructure &&
         offered.features12.bufferDeviceAddress;
}

}  // namespace

bool offers_ray_query(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance, VkPhysicalDevice device) {
  return has_ray_query(InstanceTable(get_instance_proc_addr, instance), device);
}

CandidateDevice examine_device(const InstanceTable& table, VkPhysicalDevice device) {
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver};
  table.vkGetPhysicalDeviceProperties2(device, &properties);
  CandidateDevice candidate;
  candidate.handle = device;
  candidate.type = properties.properties.deviceType;
  candidate.summary.name = properties.properties.deviceName;
  candidate.summary.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  candidate.summary.type = type_name(candidate.type);
  candidate.summary.missing = find_missing(table, device, properties.properties);
  candidate.summary.ray_query = candidate.summary.missing.empty() && has_ray_query(table, device);
  return candidate;
}

std::vector<CandidateDevice> examine_devices(const InstanceTable& table, VkInstance instance) {
  std::uint32_t count = 0;
  LW_VK(table.vkEnumeratePhysicalDevices(instance, &count, nullptr));
  std::vector<VkPhysicalDevice> handles(count);
  LW_VK(table.vkEnumeratePhysicalDevices(instance, &count, handles.data()));
  std::vector<CandidateDevice> candidates;
  for (const VkPhysicalDevice handle : handles) candidates.push_back(examine_device(table, handle));
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return rank(a.type) < rank(b.type); });
  return candidates;
}

DeviceChoice choose_device(const std::vector<CandidateDevice>& candidates, const std::string& wanted) {
  if (candidates.empty())
    throw InputError("Vulkan", "no device found; a software one is in the package mesa-vulkan-drivers");
  const bool best = wanted.empty() || wanted == "best";
  const bool number = !wanted.empty() && wanted.find_first_not_of("0123456789") == std::string::npos;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const DeviceSummary& summary = candidates[i].summary;
    const bool software = candidates[i].type == VK_PHYSICAL_DEVICE_TYPE_CPU;
    const bool named = number            ? std::to_string(i) == wanted
                       : wanted == "cpu" ? software
                                         : lower(summary.name).find(lower(wanted)) != std::string::npos;
    if (summary.missing.empty() && best)
      return {i, software ? "only a software device is usable here: expect seconds where a GPU needs milliseconds"
                          : "the best of " + std::to_string(candidates.size()) + " devices (" + summary.type + ")"};
    if (named && !best) {
      if (summary.missing.empty()) return {i, "asked for as '" + wanted + "'"};
      throw InputError("device '" + wanted + "'", summary.name + " lacks " + join(summary.missing));
    }
    known.push_back(summary.name + (summary.missing.empty() ? "" : " (lacks " + join(summary.missing) + ")"));
  }
  throw InputError(best ? "Vulkan" : "device '" + wanted + "'",
                   std::string(best ? "no usable device" : "no such device") + "; there is: " + join(known));
}

std::vector<DeviceSummary> list_devices() {
  const PFN_vkGetInstanceProcAddr get = find_vulkan_loader();
  if (!get) return {};
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  VkInstance instance = VK_NULL_HANDLE;
  auto create = reinterpret_cast<PFN_vkCreateInstance>(get(nullptr, "vkCreateInstance"));
  if (create(&info, nullptr, &instance) != VK_SUCCESS) return {};
  const InstanceTable table(get, instance);
  std::vector<DeviceSummary> summaries;
  for (const CandidateDevice& candidate : examine_devices(table, instance)) summaries.push_back(candidate.summary);
  table.vkDestroyInstance(instance, nullptr);
  return summaries;
}

}  // namespace lightwell
