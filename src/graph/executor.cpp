#include "graph/executor.h"

#include <algorithm>

#include "core/align.h"
#include "gpu/pipeline_cache.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

constexpr std::uint64_t kIdleFrames = 8;  // a pooled resource that no frame used for so long is released

std::unique_ptr<ImageResource> make_image(Device& device, std::string_view name, const ImageDesc& d) {
  return std::make_unique<ImageResource>(device, name,
                                         ImageInfo{d.format, d.width, d.height, d.depth, d.layers, d.mips, d.array});
}

VkImageAspectFlags aspect_of(VkFormat format) {
  return is_depth_format(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

// Grows `buffer` to what this frame needs, and gives it back when it is far more: a scene's first frame uploads all of
// it, the others next to nothing.
void fit_host_buffer(Device& device, std::unique_ptr<Buffer>& buffer, VkDeviceSize size, MemoryKind kind,
                     std::string_view name) {
  constexpr VkDeviceSize kSlack = VkDeviceSize{1} << 20;
  if (buffer && (buffer->size() < size || buffer->size() > 4 * size + kSlack)) buffer.reset();
  if (!buffer && size > 0) buffer = std::make_unique<Buffer>(device, name, size + size / 8, kind);
}

// Mesa's software driver bins timestamps like draws and takes them when it next flushes; dispatches run at once, before
// a timestamp that was recorded ahead of them. A barrier makes it flush.
void write_timestamp(Device& device, VkCommandBuffer commands, VkQueryPool queries, std::uint32_t query) {
  constexpr VkPipelineStageFlags2 kAll = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  device.vk().vkCmdWriteTimestamp2(commands, kAll, queries, query);
  if (device.summary().type != "software") return;
  const VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, kAll, 0, kAll, 0};
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &barrier;
  device.vk().vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace

GraphExecutor::GraphExecutor(Device& device, std::uint32_t frames_in_flight)
    : device_(device), slots_(std::max(1u, frames_in_flight)) {}

GraphExecutor::~GraphExecutor() {
  for (Slot& slot : slots_)
    device_.defer([&device = device_, pool = slot.descriptors, queries = slot.timestamps] {
      device.vk().vkDestroyDescriptorPool(device.handle(), pool, nullptr);
      device.vk().vkDestroyQueryPool(device.handle(), queries, nullptr);
    });
}

std::uint64_t GraphExecutor::record(FrameGraph& graph, VkCommandBuffer commands, std::uint64_t completed) {
  ++frame_;
  Slot& slot = slots_[frame_ % slots_.size()];
  LW_ASSERT(slot.frame <= completed, "frame " + std::to_string(slot.frame) + " must complete before frame " +
                                         std::to_string(frame_) + " is recorded");
  device_.begin_frame(frame_, completed);
  slot.frame = frame_;
  const Plan plan = make_plan(graph);
  prepare_slot(slot, graph);
  resolve_buffers(graph, plan, slot);
  resolve_images(graph, plan);
  release_unused();

  const auto& vk = device_.vk();
  const bool timed = slot.timestamps != VK_NULL_HANDLE;
  if (timed) vk.vkCmdResetQueryPool(commands, slot.timestamps, 0, slot.timestamp_capacity);
  if (device_.has_validation()) spoil_new_buffers(graph, commands);
  std::uint32_t number = 0;
  for (const Pass& pass : graph.passes()) {
    record_barriers(graph, plan.pass_uses[number], commands);
    if (timed) write_timestamp(device_, commands, slot.timestamps, 2 * number);
    record_pass(graph, pass, slot, commands);
    if (timed) write_timestamp(device_, commands, slot.timestamps, 2 * number + 1);
    slot.pass_names.push_back(pass.name);
    ++number;
  }
  record_final_layouts(graph, commands);
  graph.notify_recorded();
  return frame_;
}

// With validation, new memory holds NaN: a pass that reads what nothing wrote shows, and does so every time.
void GraphExecutor::spoil_new_buffers(const FrameGraph& graph, VkCommandBuffer commands) {
  constexpr std::uint32_t kNan = 0xffffffffu;
  for (const std::uint32_t index : new_buffers_) {
    record_barriers(graph, {{.index = index, .kind = UseKind::kTransferWrite}}, commands);
    device_.vk().vkCmdFillBuffer(commands, buffers_[index].buffer->handle(), 0, VK_WHOLE_SIZE, kNan);
  }
}

void GraphExecutor::prepare_slot(Slot& slot, const FrameGraph& graph) {
  const auto& vk = device_.vk();
  slot.pass_names.clear();
  slot.readback_offsets.clear();
  const auto passes = static_cast<std::uint32_t>(graph.passes().size());
  std::uint32_t bindings = 1;
  for (const Pass& pass : graph.passes()) bindings += static_cast<std::uint32_t>(pass.bound.size());

  const std::uint32_t wanted = std::max(passes + 1, bindings);
  if (slot.descriptor_capacity < wanted) {
    vk.vkDestroyDescriptorPool(device_.handle(), slot.descriptors, nullptr);
    slot.descriptor_capacity = wanted * 2;
    std::vector<VkDescriptorPoolSize> sizes;
    for (const VkDescriptorType type :
         {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
          VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER})
      sizes.push_back({type, slot.descriptor_capacity});
    if (device_.has_ray_query())
      sizes.push_back({VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, slot.descriptor_capacity});
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = slot.descriptor_capacity;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    LW_VK(vk.vkCreateDescriptorPool(device_.handle(), &info, nullptr, &slot.descriptors));
  } else {
    LW_VK(vk.vkResetDescriptorPool(device_.handle(), slot.descriptors, 0));
  }
  if (device_.has_timestamps() && slot.timestamp_capacity < 2 * passes) {
    vk.vkDestroyQueryPool(device_.handle(), slot.timestamps, nullptr);
    slot.timestamp_capacity = 4 * passes;
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = slot.timestamp_capacity;
    LW_VK(vk.vkCreateQueryPool(device_.handle(), &info, nullptr, &slot.timestamps));
  }
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
  for (std::size_t i = 0; i < graph.buffers().size(); ++i) {
    const BufferResource& resource = graph.buffers()[i];
    BufferBinding& binding = buffers_[i];
    binding.size = resource.desc.size;
    switch (resource.lifetime) {
      case Lifetime::kUpload:
        binding.buffer = slot.uploads.get();
        std::memcpy(slot.uploads->mapped() + binding.offset, resource.data.data(), resource.data.size());
        break;
      case Lifetime::kReadback:
        binding.buffer = slot.readbacks.get();
        slot.readback_offsets[static_cast<std::uint32_t>(i)] = binding.offset;
        break;
      case Lifetime::kImported:
        binding.buffer = resource.imported;
        break;
      case Lifetime::kHistory: {
        PoolBuffer& history = history_buffers_[resource.name];
        if (!history.buffer || !(history.desc == resource.desc)) {
          history.desc = resource.desc;
          history.buffer = std::make_unique<Buffer>(device_, resource.name, resource.desc.size, MemoryKind::kDevice);
          new_buffers_.push_back(static_cast<std::uint32_t>(i));
        }
        history.last_frame = frame_;
        binding.buffer = history.buffer.get();
        break;
      }
      case Lifetime::kTransient: {
        const std::uint32_t number = plan.buffer_slots[i];
        if (number == UINT32_MAX) break;
        if (!pooled[number]) {
          auto free = std::find_if(buffer_pool_.begin(), buffer_pool_.end(), [&](const PoolBuffer& p) {
            return p.desc == resource.desc && p.last_frame != frame_;
          });
          if (free == buffer_pool_.end()) {
            buffer_pool_.push_back({resource.desc, std::make_unique<Buffer>(device_, resource.name, resource.desc.size,
                                                                            MemoryKind::kDevice)});
            free = buffer_pool_.end() - 1;
            new_buffers_.push_back(static_cast<std::uint32_t>(i));
          }
          free->last_frame = frame_;
          pooled[number] = free->buffer.get();
        }
        binding.buffer = pooled[number];
        break;
      }
    }
  }
}

void GraphExecutor::resolve_images(const FrameGraph& graph, const Plan& plan) {
  images_.assign(graph.images().size(), nullptr);
  std::vector<ImageResource*> pooled(plan.image_pool.size(), nullptr);
  for (std::size_t i = 0; i < graph.images().size(); ++i) {
    const ImageNode& node = graph.images()[i];
    if (node.lifetime == Lifetime::kImported) {
      images_[i] = node.imported;
    } else if (node.lifetime == Lifetime::kHistory) {
      PoolImage& history = history_images_[node.name];
      if (!history.image || !(history.desc == node.desc)) {
        history.desc = node.desc;
        history.image = make_image(device_, node.name, node.desc);
      }
      history.last_frame = frame_;
      images_[i] = history.image.get();
    } else if (const std::uint32_t number = plan.image_slots[i]; number != UINT32_MAX) {
      if (!pooled[number]) {
        auto free = std::find_if(image_pool_.begin(), image_pool_.end(),
                                 [&](const PoolImage& p) { return p.desc == node.desc && p.last_frame != frame_; });
        if (free == image_pool_.end()) {
          image_pool_.push_back({node.desc, make_image(device_, node.name, node.desc)});
          free = image_pool_.end() - 1;
        }
        free->last_frame = frame_;
        pooled[number] = free->image.get();
      }
      images_[i] = pooled[number];
    }
  }
}

void GraphExecutor::release_unused() {
  std::erase_if(buffer_pool_, [&](const PoolBuffer& p) { return p.last_frame + kIdleFrames < frame_; });
  std::erase_if(image_pool_, [&](const PoolImage& p) { return p.last_frame + kIdleFrames < frame_; });
  // Histories that nobody asks for any more: the technique that owned them is gone.
  std::erase_if(history_buffers_, [&](const auto& entry) {
    if (entry.second.last_frame + kIdleFrames >= frame_) return false;
    context_.history_buffers.erase(entry.first);
    return true;
  });
  std::erase_if(history_images_, [&](const auto& entry) {
    if (entry.second.last_frame + kIdleFrames >= frame_) return false;
    context_.history_images.erase(entry.first);
    return true;
  });
}

void GraphExecutor::record_barriers(const FrameGraph& graph, const std::vector<ResourceUse>& uses,
                                    VkCommandBuffer commands) {
  std::vector<VkImageMemoryBarrier2> image_barriers;
  VkMemoryBarrier2 memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  for (const ResourceUse& use : uses) {
    const UseInfo info = describe_use(use);
    ResourceState& state = use.is_image ? images_[use.index]->state : buffers_[use.index].buffer->state;
    Barrier barrier;
    if (!advance(state, info, use.is_image, barrier)) continue;
    if (!use.is_image) {
      memory.srcStageMask |= barrier.from_stages;
      memory.srcAccessMask |= barrier.from_access;
      memory.dstStageMask |= barrier.to_stages;
      memory.dstAccessMask |= barrier.to_access;
      continue;
    }
    VkImageMemoryBarrier2 b{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    b.srcStageMask = barrier.from_stages;
    b.srcAccessMask = barrier.from_access;
    b.dstStageMask = barrier.to_stages;
    b.dstAccessMask = barrier.to_access;
    b.oldLayout = barrier.from_layout;
    b.newLayout = barrier.to_layout;
    b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    b.image = images_[use.index]->handle();
    b.subresourceRange = {aspect_of(graph.images()[use.index].desc.format), 0, VK_REMAINING_MIP_LEVELS, 0,
                          VK_REMAINING_ARRAY_LAYERS};
    image_barriers.push_back(b);
  }
  if (memory.dstStageMask == 0 && image_barriers.empty()) return;
  VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  dependency.memoryBarrierCount = memory.dstStageMask != 0 ? 1 : 0;
  dependency.pMemoryBarriers = &memory;
  dependency.imageMemoryBarrierCount = static_cast<std::uint32_t>(image_barriers.size());
  dependency.pImageMemoryBarriers = image_barriers.data();
  device_.vk().vkCmdPipelineBarrier2(commands, &dependency);
}

void GraphExecutor::record_final_layouts(const FrameGraph& graph, VkCommandBuffer commands) {
  const auto& vk = device_.vk();
  std::vector<VkImageMemoryBarrier2> barriers;
  for (std::size_t i = 0; i < graph.images().size(); ++i) {
    const ImageNode& node = graph.images()[i];
    if (!node.final_layout) continue;
    ResourceState& state = images_[i]->state;
    VkImageMemoryBarrier2 b{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    b.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    b.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    b.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    b.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    b.oldLayout = state.layout;
    b.newLayout = *node.final_layout;
    b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    b.image = images_[i]->handle();
    b.subresourceRange = {aspect_of(node.desc.format), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
    barriers.push_back(b);
    state = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT, 0, 0, *node.final_layout};
  }
  VkMemoryBarrier2 host{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  host.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  host.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  host.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  host.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &host;
  dependency.imageMemoryBarrierCount = static_cast<std::uint32_t>(barriers.size());
  dependency.pImageMemoryBarriers = barriers.data();
  vk.vkCmdPipelineBarrier2(commands, &dependency);
}

GraphExecutor::Slot& GraphExecutor::completed_slot(std::uint64_t frame) {
  Slot& slot = slots_[frame % slots_.size()];
  LW_ASSERT(slot.frame == frame, "frame " + std::to_string(frame) + " is no longer kept");
  return slot;
}

std::vector<PassTime> GraphExecutor::pass_times(std::uint64_t frame) {
  Slot& slot = completed_slot(frame);
  std::vector<PassTime> times;
  std::vector<std::uint64_t> stamps(2 * slot.pass_names.size());
  if (slot.timestamps && !stamps.empty())
    LW_VK(device_.vk().vkGetQueryPoolResults(device_.handle(), slot.timestamps, 0,
                                             static_cast<std::uint32_t>(stamps.size()),
                                             stamps.size() * sizeof(std::uint64_t), stamps.data(),
                                             sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
  for (std::size_t i = 0; i < slot.pass_names.size(); ++i) {
    const std::uint64_t ticks = (stamps[2 * i + 1] - stamps[2 * i]) & device_.timestamp_mask();
    auto same =
        std::find_if(times.begin(), times.end(), [&](const PassTime& t) { return t.name == slot.pass_names[i]; });
    if (same == times.end()) same = times.insert(times.end(), {slot.pass_names[i], 0, 0});
    same->time_ms += static_cast<double>(ticks) * device_.limits().timestampPeriod * 1e-6;
    ++same->count;
  }
  return times;
}

std::vector<std::byte> GraphExecutor::fetch(std::uint64_t frame, const ReadbackTicket& ticket) {
  Slot& slot = completed_slot(frame);
  const auto offset = slot.readback_offsets.find(ticket.buffer);
  LW_ASSERT(offset != slot.readback_offsets.end(), "this frame read nothing back under that ticket");
  const std::byte* first = slot.readbacks->mapped() + offset->second;
  return {first, first + ticket.size};
}

}  // namespace lightwell
