// Which physical device to use, and why.
#pragma once

#include <string>
#include <vector>

#include "gpu/device.h"

namespace lightwell {

struct CandidateDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  DeviceSummary summary;
};

struct DeviceChoice {
  std::size_t index = 0;
  std::string reason;
};

CandidateDevice examine_device(const InstanceTable& table, VkPhysicalDevice device);
std::vector<CandidateDevice> examine_devices(const InstanceTable& table, VkInstance instance);  // best first

// Pure: throws InputError naming --device when nothing fits, listing what there is and what it lacks.
DeviceChoice choose_device(const std::vector<CandidateDevice>& candidates, const std::string& wanted);

}  // namespace lightwell
