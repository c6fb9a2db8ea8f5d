// GPU memory: blocks of VkDeviceMemory cut into resources, every byte under a name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "gpu/deferred_destruction.h"
#include "gpu/resource_state.h"
#include "gpu/vulkan.h"

namespace lightwell {

class Device;

enum class MemoryKind : std::uint8_t { kDevice, kHostUpload, kHostReadback };

// A piece of a memory block. Freed through MemoryPool::free().
struct Allocation {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;
  VkDeviceSize size = 0;
  std::uint32_t block = UINT32_MAX;
  std::byte* mapped = nullptr;  // of host memory
};

struct MemoryUse {
  std::uint64_t bytes = 0;
  std::uint32_t count = 0;
};

// First-fit sub-allocation in blocks of 32 MiB; larger requests get a block of their own. Thread-safe.
class MemoryPool {
 public:
  explicit MemoryPool(Device& device);
  ~MemoryPool();

  // `linear`: buffers and linear images; others are kept in blocks of their own (bufferImageGranularity).
  Allocation allocate(const VkMemoryRequirements& requirements, MemoryKind kind, bool linear, std::string_view name);
  void free(const Allocation& allocation, std::string_view name);

  // Exact bytes held under each name now.
  std::map<std::string, MemoryUse> report() const;
  std::uint64_t total_bytes() const;
  std::uint64_t reserved_bytes() const;  // of the blocks, free parts included

 private:
  struct Range {
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;
  };
  struct Block {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize size = 0;
    std::uint32_t type = 0;
    bool linear = true;
    std::byte* mapped = nullptr;
    std::vector<Range> free_ranges;  // by offset
  };

  std::uint32_t find_type(std::uint32_t allowed, MemoryKind kind) const;
  std::uint32_t add_block(VkDeviceSize size, std::uint32_t type, bool linear, bool mapped, std::string_view name);
  bool take(Block& block, const VkMemoryRequirements& requirements, Allocation& result);

  Device& device_;
  VkPhysicalDeviceMemoryProperties properties_{};
  std::vector<Block> blocks_;
  std::map<std::string, MemoryUse, std::less<>> uses_;
  std::uint64_t total_ = 0;
  mutable std::mutex mutex_;
};

// Storage, uniform, index, indirect, transfer, input of acceleration structures: one kind of buffer serves all.
class Buffer {
 public:
  // `more_usage`: besides those.
  Buffer(Device& device, std::string_view name, VkDeviceSize size, MemoryKind kind, VkBufferUsageFlags more_usage = 0);
  ~Buffer();  // destroyed when the frames of `uses` are done
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  VkBuffer handle() const { return handle_; }
  VkDeviceSize size() const { return size_; }
  std::byte* mapped() const { return allocation_.mapped; }
  const std::string& name() const { return name_; }
  VkDeviceAddress address() const;  // on a device with ray queries

  ResourceState state;  // both kept by the executor from frame to frame
  FrameUses uses;

 private:
  Device& device_;
  std::string name_;
  VkDeviceSize size_ = 0;
  VkBuffer handle_ = VK_NULL_HANDLE;
  Allocation allocation_;
};

struct ImageInfo {
  VkFormat format = VK_FORMAT_UNDEFINED;
  std::uint32_t width = 1, height = 1, depth = 1, layers = 1, mips = 1;
  bool array = false;  // seen as an array in shaders even with one layer
};

// A 2D, 2D array or 3D image with the usages that its format allows. Views are made on demand and kept.
class ImageResource {
 public:
  ImageResource(Device& device, std::string_view name, const ImageInfo& info);
  // Wraps an image that a host owns and keeps alive; `layout` is the one it is in when the frame starts.
  ImageResource(Device& device, std::string_view name, const ImageInfo& info, VkImage image, VkImageLayout layout);
  ~ImageResource();  // destroyed when the frames of `uses` are done
  ImageResource(const ImageResource&) = delete;
  ImageResource& operator=(const ImageResource&) = delete;

  VkImage handle() const { return handle_; }
  const ImageInfo& info() const { return info_; }
  const std::string& name() const { return name_; }
  // View of one mip or layer, or of all where these are VK_REMAINING_MIP_LEVELS and VK_REMAINING_ARRAY_LAYERS.
  VkImageView view(VkImageViewType type, std::uint32_t mip, std::uint32_t layer);

  ImageState state;  // both kept by the executor from frame to frame
  FrameUses uses;

 private:
  Device& device_;
  std::string name_;
  ImageInfo info_;
  VkImage handle_ = VK_NULL_HANDLE;
  bool owned_ = true;
  Allocation allocation_;
  std::map<std::tuple<VkImageViewType, std::uint32_t, std::uint32_t>, VkImageView> views_;
};

}  // namespace lightwell
