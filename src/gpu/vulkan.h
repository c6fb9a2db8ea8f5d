// The one place that includes Vulkan. Device functions are called through Device::vk(), never through globals, so that
// several devices (a host engine's among them) can live side by side.
#pragma once

#include "lightwell/vulkan.h"

namespace lightwell {

// The entry point of the machine's Vulkan loader, for devices that Lightwell opens itself; null if there is none.
PFN_vkGetInstanceProcAddr find_vulkan_loader();

// Throws InputError naming the call when `result` is an error. Checked in release builds too.
void check_vk(VkResult result, const char* call);

}  // namespace lightwell

#define LW_VK(call) ::lightwell::check_vk((call), #call)
