#include "gpu/vulkan.h"

#include <dlfcn.h>

#include <string>
#include <string_view>

#include "lightwell/error.h"

namespace lightwell {

namespace {

const char* describe(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of GPU memory";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "initialisation failed";
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "layer not present";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "extension not present";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "feature not present";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "incompatible driver";
    default:
      return "error";
  }
}

// "device.vk().vkCreateImage(device.handle(), ...)": the word that begins with vk and goes on with a capital.
std::string function_name(std::string_view call) {
  std::size_t start = 0;
  while (start + 2 < call.size() &&
         !(call.substr(start, 2) == "vk" && call[start + 2] >= 'A' && call[start + 2] <= 'Z'))
    ++start;
  if (start + 2 >= call.size()) return std::string(call);
  return std::string(call.substr(start, call.find('(', start) - start));
}

}  // namespace

PFN_vkGetInstanceProcAddr find_vulkan_loader() {
  // Never closed: drivers start threads and leave them running.
  void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  return library ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr")) : nullptr;
}

void check_vk(VkResult result, const char* call) {
  if (result >= 0) return;
  throw InputError("Vulkan", std::string(describe(result)) + " (" + std::to_string(static_cast<int>(result)) + ") in " +
                                 function_name(call));
}

}  // namespace lightwell
