// The driver's pipeline cache between runs: a file a device and driver version.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace lightwell {

// $XDG_CACHE_HOME/lightwell/ or ~/.cache/lightwell/, and a name of the device and its driver; "" where there is
// neither.
std::string pipeline_cache_path(const VkPhysicalDeviceProperties& properties);

// What was written there; nothing if there is no such file or it is damaged.
std::vector<std::uint8_t> read_pipeline_data(const std::string& path);

// Writes the driver's data whole or not at all. Nothing is written where the driver keeps nothing but a header, and a
// file that cannot be written is no error: the next run compiles again.
void write_pipeline_data(const std::string& path, std::span<const std::uint8_t> data);

}  // namespace lightwell
