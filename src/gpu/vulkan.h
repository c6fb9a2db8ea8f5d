// The one place that includes Vulkan. Device functions are called through Device::vk(), never through globals, so that
// several devices (a host engine's among them) can live side by side.
#pragma once

#define VK_NO_PROTOTYPES
#include <volk.h>

namespace lightwell {

// Throws InputError naming the call when `result` is an error. Checked in release builds too.
void check_vk(VkResult result, const char* call);

}  // namespace lightwell

#define LW_VK(call) ::lightwell::check_vk((call), #call)
