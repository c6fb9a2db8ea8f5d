#include "gpu/acceleration_structure.h"

#include <algorithm>

#include "gpu/device.h"
#include "lightwell/error.h"

namespace lightwell {

AccelerationStructure::AccelerationStructure(Device& device, std::string_view name,
                                             const std::vector<TriangleRange>& ranges, bool updatable)
    : device_(&device), name_(name), flags_(VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR) {
  if (updatable) flags_ |= VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_UPDATE_BIT_KHR;
  std::uint32_t first = 0;
  for (const TriangleRange& range : ranges) {
    LW_ASSERT(range.count > 0, name_ + ": an empty range");
    // Devices must take 2^29 - 1 triangles (Vulkan 1.3, maxPrimitiveCount); corners reach no farther than a buffer.
    ranges_.push_back({range.count, first * kTriangleBytes, 0, 0});
    first += range.count;
    VkAccelerationStructureGeometryKHR& geometry = geometries_.emplace_back(
        VkAccelerationStructureGeometryKHR{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR});
    geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    geometry.flags = range.opaque ? VK_GEOMETRY_OPAQUE_BIT_KHR : VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR;
    VkAccelerationStructureGeometryTrianglesDataKHR& triangles = geometry.geometry.triangles;
    triangles = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR};
    triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    triangles.vertexStride = kTriangleBytes / 3;
    triangles.maxVertex = 3 * range.count - 1;
    triangles.indexType = VK_INDEX_TYPE_NONE_KHR;
  }
  create();
}

AccelerationStructure::AccelerationStructure(Device& device, std::string_view name, std::uint32_t instance_count)
    : device_(&device),
      name_(name),
      type_(VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR),
      flags_(VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR) {
  VkAccelerationStructureGeometryKHR& geometry = geometries_.emplace_back(
      VkAccelerationStructureGeometryKHR{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR});
  geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  geometry.geometry.instances = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR};
  ranges_.push_back({instance_count, 0, 0, 0});
  create();
}

AccelerationStructure::~AccelerationStructure() {
  if (!handle_) return;
  device_->deferred().defer(storage_->uses, [&device = *device_, handle = handle_] {
    device.vk().vkDestroyAccelerationStructureKHR(device.handle(), handle, nullptr);
  });
}

VkAccelerationStructureBuildGeometryInfoKHR AccelerationStructure::build_info() const {
  VkAccelerationStructureBuildGeometryInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
  info.type = type_;
  info.flags = flags_;
  info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
  info.geometryCount = static_cast<std::uint32_t>(geometries_.size());
  info.pGeometries = geometries_.data();
  return info;
}

void AccelerationStructure::create() {
  const auto& vk = device_->vk();
  const VkAccelerationStructureBuildGeometryInfoKHR build = build_info();
  std::vector<std::uint32_t> counts;
  for (const VkAccelerationStructureBuildRangeInfoKHR& range : ranges_) counts.push_back(range.primitiveCount);
  VkAccelerationStructureBuildSizesInfoKHR sizes{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
  vk.vkGetAccelerationStructureBuildSizesKHR(device_->handle(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &build,
                                             counts.data(), &sizes);
  // Room to round its address up.
  scratch_size_ = std::max(sizes.buildScratchSize, sizes.updateScratchSize) + device_->scratch_alignment();
  storage_ = std::make_unique<Buffer>(*device_, name_, sizes.accelerationStructureSize, MemoryKind::kDevice,
                                      VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR);
  VkAccelerationStructureCreateInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
  info.buffer = storage_->handle();
  info.size = sizes.accelerationStructureSize;
  info.type = type_;
  LW_VK(vk.vkCreateAccelerationStructureKHR(device_->handle(), &info, nullptr, &handle_));
  VkAccelerationStructureDeviceAddressInfoKHR address{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR};
  address.accelerationStructure = handle_;
  address_ = vk.vkGetAccelerationStructureDeviceAddressKHR(device_->handle(), &address);
  device_->set_name(VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, reinterpret_cast<std::uint64_t>(handle_), name_);
}

void AccelerationStructure::record_build(VkCommandBuffer commands, VkDeviceAddress input, VkDeviceAddress scratch,
                                         bool update) {
  for (VkAccelerationStructureGeometryKHR& geometry : geometries_) {
    if (type_ == VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR)
      geometry.geometry.instances.data.deviceAddress = input;
    else
      geometry.geometry.triangles.vertexData.deviceAddress = input;
  }
  VkAccelerationStructureBuildGeometryInfoKHR info = build_info();
  info.dstAccelerationStructure = handle_;
  if (update) {
    info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_UPDATE_KHR;
    info.srcAccelerationStructure = handle_;
  }
  const VkDeviceAddress alignment = device_->scratch_alignment();
  info.scratchData.deviceAddress = (scratch + alignment - 1) / alignment * alignment;
  const VkAccelerationStructureBuildRangeInfoKHR* ranges = ranges_.data();
  device_->vk().vkCmdBuildAccelerationStructuresKHR(commands, 1, &info, &ranges);
}

}  // namespace lightwell
