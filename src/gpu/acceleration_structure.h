// Acceleration structures of VK_KHR_acceleration_structure: what ray queries traverse. Only on devices that
// have them (Device::has_ray_query()).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/memory.h"
#include "gpu/vulkan.h"

namespace lightwell {

// Triangles of a bottom level: one of its geometries.
struct TriangleRange {
  std::uint32_t count = 0;
  bool opaque = true;  // false: the shader decides about every hit
};

// Three corners of three floats each, without indices.
inline constexpr std::uint32_t kTriangleBytes = 36;

// Its shape is fixed when it is made; its content comes from builds, which the frame graph declares
// (FrameGraph::build).
class AccelerationStructure {
 public:
  // None: it can be declared and planned with, but not recorded.
  AccelerationStructure() = default;
  // Bottom level: `ranges` (none of them empty) follow each other in one buffer, kTriangleBytes a triangle.
  // `updatable`: builds may start from the last one's tree where corners moved.
  AccelerationStructure(Device& device, std::string_view name, const std::vector<TriangleRange>& ranges,
                        bool updatable);
  // Top level of so many instances, given as VkAccelerationStructureInstanceKHR.
  AccelerationStructure(Device& device, std::string_view name, std::uint32_t instance_count);
  ~AccelerationStructure();  // destroyed when the frames that use its storage are done
  AccelerationStructure(const AccelerationStructure&) = delete;
  AccelerationStructure& operator=(const AccelerationStructure&) = delete;

  const std::string& name() const { return name_; }
  const VkAccelerationStructureKHR& handle() const { return handle_; }
  VkDeviceAddress address() const { return address_; }
  Buffer* storage() { return storage_.get(); }                  // holds it; its state is the structure's
  std::uint64_t scratch_size() const { return scratch_size_; }  // bytes that any build needs while it runs

  // `input`: the corners or the instances; `scratch`: scratch_size() bytes.
  void record_build(VkCommandBuffer commands, VkDeviceAddress input, VkDeviceAddress scratch, bool update);

 private:
  void create();
  VkAccelerationStructureBuildGeometryInfoKHR build_info() const;

  Device* device_ = nullptr;
  std::string name_;
  VkAccelerationStructureTypeKHR type_ = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
  VkBuildAccelerationStructureFlagsKHR flags_ = 0;
  std::vector<VkAccelerationStructureGeometryKHR> geometries_;
  std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges_;
  std::unique_ptr<Buffer> storage_;
  VkAccelerationStructureKHR handle_ = VK_NULL_HANDLE;
  VkDeviceAddress address_ = 0;
  std::uint64_t scratch_size_ = 0;
};

}  // namespace lightwell
