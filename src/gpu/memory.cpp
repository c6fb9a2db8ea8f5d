#include "gpu/memory.h"

#include <algorithm>

#include "core/align.h"
#include "gpu/device.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

constexpr VkDeviceSize kBlockSize = VkDeviceSize{32} << 20;

}  // namespace

MemoryPool::MemoryPool(Device& device) : device_(device) {
  device.instance_table().vkGetPhysicalDeviceMemoryProperties(device.physical_device(), &properties_);
}

MemoryPool::~MemoryPool() {
  for (Block& block : blocks_)
    if (block.memory) device_.vk().vkFreeMemory(device_.handle(), block.memory, nullptr);
}

std::uint32_t MemoryPool::find_type(std::uint32_t allowed, MemoryKind kind) const {
  const VkMemoryPropertyFlags host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  // Wanted flags in order of preference; the last of each row is always offered (Vulkan 1.3, section 11.6).
  const VkMemoryPropertyFlags preferences[3][2] = {{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0},
                                                   {host | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, host},
                                                   {host | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, host}};
  for (const VkMemoryPropertyFlags wanted : preferences[static_cast<int>(kind)])
    for (std::uint32_t i = 0; i < properties_.memoryTypeCount; ++i)
      if ((allowed >> i & 1u) && (properties_.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  throw InputError("Vulkan", "no memory type fits");
}

std::uint32_t MemoryPool::add_block(VkDeviceSize size, std::uint32_t type, bool linear, bool mapped,
                                    std::string_view name) {
  Block block;
  block.size = size;
  block.type = type;
  block.linear = linear;
  VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
  if (linear && device_.has_ray_query()) flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &flags, size, type};
  if (device_.vk().vkAllocateMemory(device_.handle(), &info, nullptr, &block.memory) != VK_SUCCESS)
    throw InputError("GPU memory", "cannot allocate " + std::to_string(size >> 20) + " MiB for " + std::string(name));
  if (mapped) {
    void* data = nullptr;
    LW_VK(device_.vk().vkMapMemory(device_.handle(), block.memory, 0, VK_WHOLE_SIZE, 0, &data));
    block.mapped = static_cast<std::byte*>(data);
  }
  block.free_ranges = {{0, size}};
  const auto hole = std::find_if(blocks_.begin(), blocks_.end(), [](const Block& b) { return !b.memory; });
  const auto index = static_cast<std::uint32_t>(hole - blocks_.begin());
  if (hole == blocks_.end())
    blocks_.push_back(std::move(block));
  else
    *hole = std::move(block);
  return index;
}

bool MemoryPool::take(Block& block, const VkMemoryRequirements& requirements, Allocation& result) {
  for (std::size_t i = 0; i < block.free_ranges.size(); ++i) {
    const Range range = block.free_ranges[i];
    const VkDeviceSize offset = align_up(range.offset, requirements.alignment);
    const VkDeviceSize end = offset + requirements.size;
    if (end > range.offset + range.size) continue;
    // Cut [offset, end) out of the range; up to two pieces stay free.
    block.free_ranges.erase(block.free_ranges.begin() + static_cast<std::ptrdiff_t>(i));
    auto at = block.free_ranges.begin() + static_cast<std::ptrdiff_t>(i);
    if (end < range.offset + range.size) at = block.free_ranges.insert(at, {end, range.offset + range.size - end});
    if (offset > range.offset) block.free_ranges.insert(at, {range.offset, offset - range.offset});
    result.memory = block.memory;
    result.offset = offset;
    result.size = requirements.size;
    result.mapped = block.mapped ? block.mapped + offset : nullptr;
    return true;
  }
  return false;
}

Allocation MemoryPool::allocate(const VkMemoryRequirements& requirements, MemoryKind kind, bool linear,
                                std::string_view name) {
  const std::lock_guard lock(mutex_);
  const std::uint32_t type = find_type(requirements.memoryTypeBits, kind);
  const bool host = kind != MemoryKind::kDevice;
  Allocation result;
  bool found = false;
  for (std::uint32_t i = 0; i < blocks_.size() && !found; ++i) {
    Block& block = blocks_[i];
    if (!block.memory || block.type != type || block.linear != linear || (block.mapped != nullptr) != host) continue;
    found = take(block, requirements, result);
    if (found) result.block = i;
  }
  if (!found) {
    result.block = add_block(std::max(kBlockSize, requirements.size), type, linear, host, name);
    LW_ASSERT(take(blocks_[result.block], requirements, result), "a new block does not hold its first resource");
  }
  MemoryUse& use = uses_[std::string(name)];
  use.bytes += result.size;
  ++use.count;
  total_ += result.size;
  return result;
}

void MemoryPool::free(const Allocation& allocation, std::string_view name) {
  const std::lock_guard lock(mutex_);
  Block& block = blocks_[allocation.block];
  auto& ranges = block.free_ranges;
  auto next = std::find_if(ranges.begin(), ranges.end(), [&](const Range& r) { return r.offset > allocation.offset; });
  auto it = ranges.insert(next, {allocation.offset, allocation.size});
  if (it + 1 != ranges.end() && it->offset + it->size == (it + 1)->offset) {
    it->size += (it + 1)->size;
    ranges.erase(it + 1);
  }
  if (it != ranges.begin() && (it - 1)->offset + (it - 1)->size == it->offset) {
    (it - 1)->size += it->size;
    ranges.erase(it);
  }
  if (ranges.size() == 1 && ranges.front().size == block.size) {
    device_.vk().vkFreeMemory(device_.handle(), block.memory, nullptr);
    block = {};
  }
  MemoryUse& use = uses_.find(name)->second;
  use.bytes -= allocation.size;
  --use.count;
  total_ -= allocation.size;
}

std::map<std::string, MemoryUse> MemoryPool::report() const {
  const std::lock_guard lock(mutex_);
  return {uses_.begin(), uses_.end()};
}

std::uint64_t MemoryPool::total_bytes() const {
  const std::lock_guard lock(mutex_);
  return total_;
}

std::uint64_t MemoryPool::reserved_bytes() const {
  const std::lock_guard lock(mutex_);
  std::uint64_t sum = 0;
  for (const Block& block : blocks_) sum += block.size;
  return sum;
}

Buffer::Buffer(Device& device, std::string_view name, VkDeviceSize size, MemoryKind kind, VkBufferUsageFlags more_usage)
    : device_(device), name_(name), size_(std::max<VkDeviceSize>(size, 16)) {
  if (size_ > device.largest_buffer())
    throw InputError("GPU memory", name_ + " need " + std::to_string(size_ >> 20) +
                                       " MiB; a buffer of this device holds " +
                                       std::to_string(device.largest_buffer() >> 20) + " MiB");
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size_;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
               VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | more_usage;
  if (device.has_ray_query())
    info.usage |= VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                  VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;
  LW_VK(device.vk().vkCreateBuffer(device.handle(), &info, nullptr, &handle_));
  VkMemoryRequirements requirements;
  device.vk().vkGetBufferMemoryRequirements(device.handle(), handle_, &requirements);
  try {
    allocation_ = device.memory().allocate(requirements, kind, true, name_);
  } catch (...) {
    device.vk().vkDestroyBuffer(device.handle(), handle_, nullptr);
    throw;
  }
  LW_VK(device.vk().vkBindBufferMemory(device.handle(), handle_, allocation_.memory, allocation_.offset));
  device.set_name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(handle_), name_);
}

Buffer::~Buffer() {
  device_.deferred().defer(uses, [&device = device_, handle = handle_, allocation = allocation_, name = name_] {
    device.vk().vkDestroyBuffer(device.handle(), handle, nullptr);
    device.memory().free(allocation, name);
  });
}

VkDeviceAddress Buffer::address() const {
  VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
  info.buffer = handle_;
  return device_.vk().vkGetBufferDeviceAddress(device_.handle(), &info);
}

ImageResource::ImageResource(Device& device, std::string_view name, const ImageInfo& image)
    : device_(device), name_(name), info_(image) {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = image.depth > 1 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
  info.format = image.format;
  info.extent = {image.width, image.height, image.depth};
  info.mipLevels = image.mips;
  info.arrayLayers = image.layers;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = device.usages(image.format);
  if (info.imageType == VK_IMAGE_TYPE_3D) info.usage &= ~VkImageUsageFlags{VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT};
  LW_VK(device.vk().vkCreateImage(device.handle(), &info, nullptr, &handle_));
  VkMemoryRequirements requirements;
  device.vk().vkGetImageMemoryRequirements(device.handle(), handle_, &requirements);
  try {
    allocation_ = device.memory().allocate(requirements, MemoryKind::kDevice, false, name_);
  } catch (...) {
    device.vk().vkDestroyImage(device.handle(), handle_, nullptr);
    throw;
  }
  LW_VK(device.vk().vkBindImageMemory(device.handle(), handle_, allocation_.memory, allocation_.offset));
  device.set_name(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(handle_), name_);
}

ImageResource::ImageResource(Device& device, std::string_view name, const ImageInfo& info, VkImage image,
                             VkImageLayout layout)
    : device_(device), name_(name), info_(info), handle_(image), owned_(false) {
  state.whole.layout = layout;
}

ImageResource::~ImageResource() {
  device_.deferred().defer(uses, [&device = device_, handle = handle_, owned = owned_, allocation = allocation_,
                                  name = name_, views = std::move(views_)] {
    for (const auto& [key, view] : views) device.vk().vkDestroyImageView(device.handle(), view, nullptr);
    if (!owned) return;
    device.vk().vkDestroyImage(device.handle(), handle, nullptr);
    device.memory().free(allocation, name);
  });
}

VkImageView ImageResource::view(VkImageViewType type, std::uint32_t mip, std::uint32_t layer) {
  VkImageView& view = views_[{type, mip, layer}];
  if (view) return view;
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.image = handle_;
  info.viewType = type;
  info.format = info_.format;
  const bool depth = info_.format == VK_FORMAT_D32_SFLOAT || info_.format == VK_FORMAT_D16_UNORM;
  info.subresourceRange = {
      static_cast<VkImageAspectFlags>(depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT),
      mip == VK_REMAINING_MIP_LEVELS ? 0 : mip, mip == VK_REMAINING_MIP_LEVELS ? info_.mips : 1,
      layer == VK_REMAINING_ARRAY_LAYERS ? 0 : layer, layer == VK_REMAINING_ARRAY_LAYERS ? info_.layers : 1};
  LW_VK(device_.vk().vkCreateImageView(device_.handle(), &info, nullptr, &view));
  return view;
}

}  // namespace lightwell
