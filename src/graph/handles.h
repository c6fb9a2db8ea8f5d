// What passes exchange: handles of this frame's buffers, images and acceleration structures, and how they are
// described.
#pragma once

#include <cstdint>

#include "gpu/vulkan.h"

namespace lightwell {

// A write gives a handle a new version; copies of the old one are stale, and using one stops the program by name.
struct BufferHandle {
  std::uint32_t index = UINT32_MAX;
  std::uint32_t version = 0;
  explicit operator bool() const { return index != UINT32_MAX; }
};

struct ImageHandle {
  std::uint32_t index = UINT32_MAX;
  std::uint32_t version = 0;
  explicit operator bool() const { return index != UINT32_MAX; }
};

// Of an AccelerationStructure that somebody owns (import_acceleration_structure); it lies among the buffers.
struct AccelerationStructureHandle {
  std::uint32_t index = UINT32_MAX;
  std::uint32_t version = 0;
  explicit operator bool() const { return index != UINT32_MAX; }
};

// Of a ResourceSet.
struct SetHandle {
  std::uint32_t index = UINT32_MAX;
  explicit operator bool() const { return index != UINT32_MAX; }
};

struct BufferDesc {
  std::uint64_t size = 0;    // bytes
  std::uint32_t stride = 0;  // of an element; 0: not checked against the shader
  bool operator==(const BufferDesc&) const = default;
};

struct ImageDesc {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  std::uint32_t depth = 1;  // > 1: a 3D image
  std::uint32_t layers = 1;
  std::uint32_t mips = 1;
  VkFormat format = VK_FORMAT_UNDEFINED;
  bool array = false;  // seen as an array in shaders even with one layer
  bool operator==(const ImageDesc&) const = default;
};

// Which mips and layers of an image a use concerns. One layer of an array is seen as a 2D image in shaders.
struct Subresource {
  static constexpr std::uint32_t kAll = UINT32_MAX;
  std::uint32_t mip = kAll;
  std::uint32_t layer = kAll;
  bool operator==(const Subresource&) const = default;
};

inline constexpr Subresource kWholeImage{};
constexpr Subresource mip_of(std::uint32_t mip) {
  return {mip, Subresource::kAll};
}
constexpr Subresource layer_of(std::uint32_t layer) {
  return {Subresource::kAll, layer};
}

// A history that is read as it was last frame and written anew. `valid`: `previous` was written last frame, and nothing
// was cut since. Where it is not, `previous` may be bound, but its content means nothing.
struct BufferPair {
  BufferHandle previous;
  BufferHandle current;
  bool valid = false;
};

struct ImagePair {
  ImageHandle previous;
  ImageHandle current;
  bool valid = false;
};

enum class SamplerKind : std::uint8_t { kNearestClamp, kLinearClamp, kLinearRepeat, kNearestRepeat, kShadow };

// Bytes of one texel; asserts on formats that the graph does not know.
std::uint32_t texel_size(VkFormat format);
bool is_depth_format(VkFormat format);

}  // namespace lightwell
