#include "graph/executor.h"

#include <algorithm>
#include <utility>

#include "gpu/pipeline_cache.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

VkImageAspectFlags aspect_of(VkFormat format) {
  return is_depth_format(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

VkImageMemoryBarrier2 image_barrier(const ImageResource& image, const ImageDesc& desc, const Barrier& barrier) {
  VkImageMemoryBarrier2 b{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  b.srcStageMask = barrier.from_stages;
  b.srcAccessMask = barrier.from_access;
  b.dstStageMask = barrier.to_stages;
  b.dstAccessMask = barrier.to_access;
  b.oldLayout = barrier.from_layout;
  b.newLayout = barrier.to_layout;
  b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  b.image = image.handle();
  const bool all_mips = barrier.part.mip == Subresource::kAll;
  const bool all_layers = barrier.part.layer == Subresource::kAll;
  b.subresourceRange = {aspect_of(desc.format), all_mips ? 0 : barrier.part.mip, all_mips ? VK_REMAINING_MIP_LEVELS : 1,
                        all_layers ? 0 : barrier.part.layer, all_layers ? VK_REMAINING_ARRAY_LAYERS : 1};
  return b;
}

// Mesa's software driver bins timestamps like draws and takes them when it next flushes; dispatches run at once, before
// a timestamp that was recorded ahead of them. A barrier makes it flush. It bins them in every tile of what was
// rendered to last: behind a large shadow atlas that is 3 ms each, behind a pixel nothing.
void write_timestamp(Device& device, VkCommandBuffer commands, VkQueryPool queries, std::uint32_t query) {
  constexpr VkPipelineStageFlags2 kAll = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  const auto& vk = device.vk();
  const bool bins = device.summary().type == "software";
  if (bins) {
    VkRenderingInfo pixel{VK_STRUCTURE_TYPE_RENDERING_INFO};
    pixel.renderArea.extent = {1, 1};
    pixel.layerCount = 1;
    vk.vkCmdBeginRendering(commands, &pixel);
    vk.vkCmdEndRendering(commands);
  }
  vk.vkCmdWriteTimestamp2(commands, kAll, queries, query);
  if (!bins) return;
  const VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, kAll, 0, kAll, 0};
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &barrier;
  vk.vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace

GraphExecutor::GraphExecutor(Device& device, std::uint32_t frames_in_flight)
    : device_(device), timeline_(device.deferred()), slots_(std::max(1u, frames_in_flight)) {
  context_.descriptor_range = device.descriptor_range();
}

GraphExecutor::~GraphExecutor() {
  for (Slot& slot : slots_) {
    device_.vk().vkDestroyDescriptorPool(device_.handle(), slot.descriptors, nullptr);
    device_.vk().vkDestroyQueryPool(device_.handle(), slot.timestamps, nullptr);
  }
}

std::uint64_t GraphExecutor::record(FrameGraph& graph, VkCommandBuffer commands, std::uint64_t completed) {
  const std::uint64_t frame = frame_ + 1;
  Slot& slot = slots_[frame % slots_.size()];
  LW_ASSERT(slot.frame <= completed, "frame " + std::to_string(slot.frame) + " must complete before frame " +
                                         std::to_string(frame) + " is recorded");
  notice_completed(completed);
  const Plan plan = make_plan(graph);
  find_pipelines(graph, plan);
  timeline_.begin_frame(frame, completed);
  prepare_slot(slot, graph);
  resolve_buffers(graph, plan, slot);
  resolve_images(graph, plan);
  note_uses();
  release_unused();

  const auto& vk = device_.vk();
  const bool timed = slot.timestamps != VK_NULL_HANDLE;
  if (timed) vk.vkCmdResetQueryPool(commands, slot.timestamps, 0, slot.timestamp_capacity);
  if (device_.has_validation()) poison_new_buffers(graph, commands);
  for (std::size_t i = 0; i < graph.passes().size(); ++i) {
    if (!plan.is_alive[i]) continue;
    record_barriers(graph, plan.pass_uses[i], commands);
    const auto query = static_cast<std::uint32_t>(2 * slot.pass_names.size());
    if (timed) write_timestamp(device_, commands, slot.timestamps, query);
    record_pass(graph, graph.passes()[i], slot, commands);
    if (timed) write_timestamp(device_, commands, slot.timestamps, query + 1);
    slot.pass_names.push_back(base_of(graph.passes()[i]).name);
  }
  record_final_layouts(graph, commands);
  slot.frame = frame_ = frame;
  slot.watchers = graph.take_watchers();
  graph.note_recorded(plan.is_alive);
  return frame_;
}

void GraphExecutor::notice_completed(std::uint64_t completed) {
  for (Slot& slot : slots_) {
    if (slot.frame > completed) continue;
    for (const auto& [ticket, done] : std::exchange(slot.watchers, {})) done(fetch(slot.frame, ticket));
  }
}

// What the frame declared lives until the frame is done, whoever lets go of it before. Being bound is not asked for: a
// top level reads its bottom levels by address.
void GraphExecutor::note_uses() {
  for (const BufferBinding& binding : buffers_)
    if (binding.buffer) timeline_.add_use(binding.buffer->uses);
  for (ImageResource* image : images_)
    if (image) timeline_.add_use(image->uses);
}

// With validation, new memory is filled with NaN: a pass that reads what nothing wrote shows, and does so every time.
void GraphExecutor::poison_new_buffers(const FrameGraph& graph, VkCommandBuffer commands) {
  constexpr std::uint32_t kNan = 0xffffffffu;
  for (const std::uint32_t index : new_buffers_) {
    record_barriers(graph, {{.index = index, .kind = UseKind::kTransferWrite}}, commands);
    device_.vk().vkCmdFillBuffer(commands, buffers_[index].buffer->handle(), 0, VK_WHOLE_SIZE, kNan);
  }
}

void GraphExecutor::record_barriers(const FrameGraph& graph, const std::vector<ResourceUse>& uses,
                                    VkCommandBuffer commands) {
  std::vector<VkImageMemoryBarrier2> image_barriers;
  VkMemoryBarrier2 memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  std::vector<Barrier> needed;
  for (const ResourceUse& use : uses) {
    const UseInfo info = describe_use(use);
    needed.clear();
    if (use.is_image) {
      advance(images_[use.index]->state, graph.images()[use.index].desc, info, use.part, needed);
    } else {
      Barrier& barrier = needed.emplace_back();
      if (!advance(buffers_[use.index].buffer->state, info, false, barrier)) needed.clear();
    }
    for (const Barrier& barrier : needed) {
      if (use.is_image) {
        image_barriers.push_back(image_barrier(*images_[use.index], graph.images()[use.index].desc, barrier));
        continue;
      }
      memory.srcStageMask |= barrier.from_stages;
      memory.srcAccessMask |= barrier.from_access;
      memory.dstStageMask |= barrier.to_stages;
      memory.dstAccessMask |= barrier.to_access;
    }
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
    Barrier barrier;
    barrier.from_stages = barrier.to_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.from_access = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.to_access = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.from_layout = images_[i]->state.whole.layout;
    barrier.to_layout = *node.final_layout;
    barriers.push_back(image_barrier(*images_[i], node.desc, barrier));
    images_[i]->state = {{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT, 0, 0, *node.final_layout},
                         {}};
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
