// Vulkan's types for the public headers, without prototypes. A host that wants prototypes includes its own Vulkan
// header first.
#pragma once

#ifndef VULKAN_CORE_H_
#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>
#endif
