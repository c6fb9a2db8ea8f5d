// GraphExecutor: the physical side of what a frame declares.
#include <algorithm>
#include <array>
#include <cstring>

#include "core/align.h"
#include "graph/executor.h"
#include "graph/pages.h"

namespace lightwell {

namespace {

constexpr std::uint64_t kIdleFrames = 8;  // a pooled resource that no frame used for so long is released

std::unique_ptr<ImageResource> make_image(Device& device, std::string_view name, const ImageDesc& d) {
  return std::make_unique<ImageResource>(device, name,
                                         ImageInfo{d.format, d.width, d.height, d.depth, d.layers, d.mips, d.array});
}

// Grows `buffer` to what this frame needs, and gives it back when it is far more: a scene's first frame uploads all of
// it, the others next to nothing.
void fit_host_buffer(Device& device, std::unique_ptr<Buffer>& buffer, VkDeviceSize size, MemoryKind kind,
                     std::string_view name) {
  constexpr VkDeviceSize kSlack = VkDeviceSize{1} << 20;
  if (buffer && (buffer->size() < size || buffer->size() > 4 * size + kSlack)) buffer.reset();
  if (!buffer && size > 0) buffer = std::make_unique<Buffer>(device, name, size + size / 8, kind);
}

}  // namespace

void GraphExecutor::prepare_slot(Slot& slot, const FrameGraph& graph) {
  const auto& vk = device_.vk();
  slot.pass_names.clear();
  slot.readback_offsets.clear();
  slot.shared_sets.clear();
  const auto passes = static_cast<std::uint32_t>(graph.passes().size());
  // Shared sets have one layout; pipelines that declare only a part of one make do with some more.
  constexpr std::uint32_t kLayoutsOfASet = 4;
  std::uint32_t wanted = passes + 1 + kLayoutsOfASet * static_cast<std::uint32_t>(graph.sets().size());
  std::uint32_t bindings = 0;
  for (const Pass& pass : graph.passes())
    if (const ShaderPassBase* shader = shader_pass(pass))
      for (const BoundResource& resource : shader->bound) bindings += resource.binding.count;
  for (const ResourceSet& set : graph.sets())
    bindings += kLayoutsOfASet * kMaximumPages * static_cast<std::uint32_t>(set.members.size());
  wanted = std::max(wanted, bindings);

  if (slot.descriptor_capacity < wanted) {
    vk.vkDestroyDescriptorPool(device_.handle(), slot.descriptors, nullptr);
    slot.descriptors = VK_NULL_HANDLE;
    slot.descriptor_capacity = 0;
    std::vector<VkDescriptorPoolSize> sizes;
    for (const VkDescriptorType type :
         {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
          VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER})
      sizes.push_back({type, 2 * wanted});
    if (device_.has_ray_query()) sizes.push_back({VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, 2 * wanted});
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = 2 * wanted;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    LW_VK(vk.vkCreateDescriptorPool(device_.handle(), &info, nullptr, &slot.descriptors));
    slot.descriptor_capacity = 2 * wanted;
  } else {
    LW_VK(vk.vkResetDescriptorPool(device_.handle(), slot.descriptors, 0));
  }
  if (device_.has_timestamps() && slot.timestamp_capacity < 2 * passes) {
    vk.vkDestroyQueryPool(device_.handle(), slot.timestamps, nullptr);
    slot.timestamps = VK_NULL_HANDLE;
    slot.timestamp_capacity = 0;
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = 4 * passes;
    LW_VK(vk.vkCreateQueryPool(device_.handle(), &info, nullptr, &slot.timestamps));
    slot.timestamp_capacity = 4 * passes;
  }
}

Buffer* GraphExecutor::find_history(const BufferResource& resource, std::uint32_t index) {
  PoolBuffer& history = history_buffers_[{resource.history.name, resource.history.side}];
  if (!history.buffer || !(history.desc == resource.desc)) {
    history.buffer = std::make_unique<Buffer>(device_, resource.name, resource.desc.size, MemoryKind::kDevice);
    history.desc = resource.desc;
    new_buffers_.push_back(index);
  }
  history.last_frame = frame_ + 1;
  return history.buffer.get();
}

// One that no other slot of this frame's plan has taken.
Buffer* GraphExecutor::find_transient(const BufferResource& resource, std::uint32_t index) {
  const std::uint64_t frame = frame_ + 1;
  auto free = std::find_if(buffer_pool_.begin(), buffer_pool_.end(),
                           [&](const PoolBuffer& p) { return p.desc == resource.desc && p.last_frame != frame; });
  if (free == buffer_pool_.end()) {
    buffer_pool_.push_back(
        {resource.desc, std::make_unique<Buffer>(device_, resource.name, resource.desc.size, MemoryKind::kDevice)});
    free = buffer_pool_.end() - 1;
    new_buffers_.push_back(index);
  }
  free->last_frame = frame;
  return free->buffer.get();
}

void GraphExecutor::resolve_buffers(const FrameGraph& graph, const Plan& plan, Slot& slot) {
  // Uploads and readbacks: pieces of one host buffer each.
  const VkDeviceSize alignment = std::max<VkDeviceSize>(
      {device_.limits().minStorageBufferOffsetAlignment, device_.limits().minUniformBufferOffsetAlignment, 16});
  VkDeviceSize upload_size = 0;
  VkDeviceSize readback_size = 0;
  buffers_.assign(graph.buffers().size(), {});
  new_buffers_.clear();
  for (std::size_t i = 0; i < graph.buffers().size(); ++i) {
    const BufferResource& resource = graph.buffers()[i];
    VkDeviceSize* total = resource.lifetime == Lifetime::kUpload     ? &upload_size
                          : resource.lifetime == Lifetime::kReadback ? &readback_size
                                                                     : nullptr;
    if (!total) continue;
    buffers_[i].offset = *total;
    *total += align_up(resource.desc.size, alignment);
  }
  fit_host_buffer(device_, slot.uploads, upload_size, MemoryKind::kHostUpload, "uploads");
  fit_host_buffer(device_, slot.readbacks, readback_size, MemoryKind::kHostReadback, "read back");
  if (slot.uploads) slot.uploads->state = {};
  if (slot.readbacks) slot.readbacks->state = {};

  std::vector<Buffer*> pooled(plan.buffer_pool.size(), nullptr);
  for (std::uint32_t i = 0; i < graph.buffers().size(); ++i) {
    const BufferResource& resource = graph.buffers()[i];
    BufferBinding& binding = buffers_[i];
    binding.size = resource.desc.size;
    switch (resource.lifetime) {
      case Lifetime::kUpload:
        binding.buffer = slot.uploads.get();
        std::copy(resource.data.begin(), resource.data.end(), slot.uploads->mapped() + binding.offset);
        break;
      case Lifetime::kReadback:
        binding.buffer = slot.readbacks.get();
        slot.readback_offsets[i] = binding.offset;
        break;
      case Lifetime::kImported:
        binding.buffer = resource.imported;
        break;
      case Lifetime::kHistory:
        binding.buffer = find_history(resource, i);
        break;
      case Lifetime::kTransient: {
        const std::uint32_t number = plan.buffer_slots[i];
        if (number == UINT32_MAX) break;
        if (!pooled[number]) pooled[number] = find_transient(resource, i);
        binding.buffer = pooled[number];
        break;
      }
    }
  }
}

void GraphExecutor::resolve_images(const FrameGraph& graph, const Plan& plan) {
  const std::uint64_t frame = frame_ + 1;
  images_.assign(graph.images().size(), nullptr);
  std::vector<ImageResource*> pooled(plan.image_pool.size(), nullptr);
  for (std::size_t i = 0; i < graph.images().size(); ++i) {
    const ImageNode& node = graph.images()[i];
    if (node.lifetime == Lifetime::kImported) {
      images_[i] = node.imported;
    } else if (node.lifetime == Lifetime::kHistory) {
      PoolImage& history = history_images_[{node.history.name, node.history.side}];
      if (!history.image || !(history.desc == node.desc)) {
        history.image = make_image(device_, node.name, node.desc);
        history.desc = node.desc;
      }
      history.last_frame = frame;
      images_[i] = history.image.get();
    } else if (const std::uint32_t number = plan.image_slots[i]; number != UINT32_MAX) {
      if (!pooled[number]) {
        auto free = std::find_if(image_pool_.begin(), image_pool_.end(),
                                 [&](const PoolImage& p) { return p.desc == node.desc && p.last_frame != frame; });
        if (free == image_pool_.end()) {
          image_pool_.push_back({node.desc, make_image(device_, node.name, node.desc)});
          free = image_pool_.end() - 1;
        }
        free->last_frame = frame;
        pooled[number] = free->image.get();
      }
      images_[i] = pooled[number];
    }
  }
}

void GraphExecutor::release_unused() {
  const auto idle = [&](std::uint64_t last_frame) { return last_frame + kIdleFrames < frame_ + 1; };
  std::erase_if(buffer_pool_, [&](const PoolBuffer& p) { return idle(p.last_frame); });
  std::erase_if(image_pool_, [&](const PoolImage& p) { return idle(p.last_frame); });
  // Histories that nobody asks for any more: the technique that owned them is gone.
  std::erase_if(history_buffers_, [&](const auto& entry) {
    if (!idle(entry.second.last_frame)) return false;
    context_.history_buffers.erase(entry.first.first);
    return true;
  });
  std::erase_if(history_images_, [&](const auto& entry) {
    if (!idle(entry.second.last_frame)) return false;
    context_.history_images.erase(entry.first.first);
    return true;
  });
}

}  // namespace lightwell
