// Instance-level functions, and the features that devices are made with.
#include <type_traits>

#include "gpu/device.h"

namespace lightwell {

RequiredFeatures::RequiredFeatures(bool ray_query) {
  features13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  features13.dynamicRendering = VK_TRUE;
  features13.synchronization2 = VK_TRUE;
  features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  features12.pNext = &features13;
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.pNext = &features12;
  features.features.robustBufferAccess = VK_TRUE;
  features.features.fragmentStoresAndAtomics = VK_TRUE;
  if (!ray_query) return;
  ray_queries.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
  ray_queries.rayQuery = VK_TRUE;
  acceleration_structures.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
  acceleration_structures.pNext = &ray_queries;
  acceleration_structures.accelerationStructure = VK_TRUE;
  features13.pNext = &acceleration_structures;
  features12.bufferDeviceAddress = VK_TRUE;
  extensions = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_QUERY_EXTENSION_NAME,
                VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};
}

InstanceTable::InstanceTable(PFN_vkGetInstanceProcAddr get, VkInstance instance) {
  const auto load = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(get(instance, name));
  };
#define LW_LOAD(name) load(name, #name)
  LW_LOAD(vkDestroyInstance);
  LW_LOAD(vkEnumeratePhysicalDevices);
  LW_LOAD(vkGetPhysicalDeviceProperties2);
  LW_LOAD(vkGetPhysicalDeviceFeatures2);
  LW_LOAD(vkGetPhysicalDeviceMemoryProperties);
  LW_LOAD(vkGetPhysicalDeviceFormatProperties);
  LW_LOAD(vkGetPhysicalDeviceQueueFamilyProperties);
  LW_LOAD(vkEnumerateDeviceExtensionProperties);
  LW_LOAD(vkCreateDevice);
  LW_LOAD(vkGetDeviceProcAddr);
  LW_LOAD(vkCreateDebugUtilsMessengerEXT);
  LW_LOAD(vkDestroyDebugUtilsMessengerEXT);
  LW_LOAD(vkCmdBeginDebugUtilsLabelEXT);
  LW_LOAD(vkCmdEndDebugUtilsLabelEXT);
  LW_LOAD(vkSetDebugUtilsObjectNameEXT);
#undef LW_LOAD
}

}  // namespace lightwell
