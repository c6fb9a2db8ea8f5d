// GraphExecutor: recording of single passes.
#include <algorithm>
#include <array>

#include "gpu/acceleration_structure.h"
#include "gpu/pipeline_cache.h"
#include "graph/executor.h"
#include "graph/pages.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

VkImageViewType view_type(ShaderImageKind kind) {
  switch (kind) {
    case ShaderImageKind::k2DArray:
      return VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    case ShaderImageKind::k3D:
      return VK_IMAGE_VIEW_TYPE_3D;
    default:
      return VK_IMAGE_VIEW_TYPE_2D;
  }
}

VkImageView view_of(ImageResource& image, VkImageViewType type, Subresource part) {
  return image.view(type, part.mip == Subresource::kAll ? VK_REMAINING_MIP_LEVELS : part.mip,
                    part.layer == Subresource::kAll ? VK_REMAINING_ARRAY_LAYERS : part.layer);
}

VkImageLayout layout_of(const ResourceUse& use) {
  return describe_use(use).layout;
}

// `raster`: the same pass, where it is one.
PipelineRequest pipeline_request(const FrameGraph& graph, const ShaderPassBase& pass, const RasterPass* raster) {
  PipelineRequest request;
  for (std::size_t i = 0; i < pass.codes.size(); ++i) request.stages.push_back({pass.codes[i], pass.stages[i]});
  request.constants = pass.constants;
  if (!raster) return request;
  request.state.raster = raster->raster;
  for (const Attachment& color : raster->colors) request.state.color_formats.push_back(graph.desc(color.image).format);
  if (raster->depth_attachment) request.state.depth_format = graph.desc(raster->depth_attachment->image).format;
  return request;
}

}  // namespace

// Those of the whole frame at once: what is missing is made on all cores.
void GraphExecutor::find_pipelines(const FrameGraph& graph, const Plan& plan) {
  std::vector<const ShaderPassBase*> passes;
  std::vector<PipelineRequest> requests;
  for (std::size_t i = 0; i < graph.passes().size(); ++i) {
    const ShaderPassBase* pass = shader_pass(graph.passes()[i]);
    if (!plan.is_alive[i] || !pass) continue;
    passes.push_back(pass);
    requests.push_back(pipeline_request(graph, *pass, std::get_if<RasterPass>(&graph.passes()[i])));
  }
  const std::vector<const Pipeline*> found = device_.pipelines().find_or_make(requests);
  pipelines_.clear();
  for (std::size_t i = 0; i < passes.size(); ++i) pipelines_.emplace(passes[i], found[i]);
}

void GraphExecutor::record_pass(const FrameGraph& graph, const Pass& pass, Slot& slot, VkCommandBuffer commands) {
  const InstanceTable& labels = device_.instance_table();
  const bool labelled = labels.vkCmdBeginDebugUtilsLabelEXT && labels.vkCmdEndDebugUtilsLabelEXT;
  if (labelled) {
    VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
    label.pLabelName = base_of(pass).name.c_str();
    labels.vkCmdBeginDebugUtilsLabelEXT(commands, &label);
  }
  std::visit([&](const auto& kind) { record_kind(graph, kind, slot, commands); }, pass);
  if (labelled) labels.vkCmdEndDebugUtilsLabelEXT(commands);
}

// ---- descriptors ----

VkDescriptorSet GraphExecutor::write_descriptors(const FrameGraph& graph, const std::vector<BoundResource>& bound,
                                                 VkDescriptorSetLayout layout, Slot& slot) {
  VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  allocate.descriptorPool = slot.descriptors;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  LW_VK(device_.vk().vkAllocateDescriptorSets(device_.handle(), &allocate, &set));

  std::vector<std::vector<VkDescriptorBufferInfo>> buffer_infos(bound.size());
  std::vector<VkDescriptorImageInfo> image_infos(bound.size());
  std::vector<VkWriteDescriptorSetAccelerationStructureKHR> structure_infos(bound.size());
  std::vector<VkWriteDescriptorSet> writes;
  for (std::size_t i = 0; i < bound.size(); ++i) {
    const BoundResource& resource = bound[i];
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.dstBinding = resource.binding.binding;
    write.descriptorCount = resource.binding.count;
    write.descriptorType = resource.binding.type;
    if (resource.use.is_image) {
      VkDescriptorImageInfo& info = image_infos[i];
      // A storage image shows one mip; the only one has no name.
      Subresource part = resource.use.part;
      if (resource.binding.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE && part.mip == Subresource::kAll) part.mip = 0;
      info.imageView = view_of(*images_[resource.use.index], view_type(resource.binding.image_kind), part);
      info.imageLayout = layout_of(resource.use);
      if (resource.binding.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER)
        info.sampler = device_.sampler(static_cast<std::uint8_t>(resource.sampler));
      write.pImageInfo = &info;
    } else if (resource.use.kind == UseKind::kAccelerationStructureRead) {
      VkWriteDescriptorSetAccelerationStructureKHR& info = structure_infos[i];
      info.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR;
      info.accelerationStructureCount = 1;
      info.pAccelerationStructures = &graph.buffers()[resource.use.index].structure->handle();
      write.pNext = &info;
    } else {
      buffer_infos[i] = describe_pages(resource);
      write.pBufferInfo = buffer_infos[i].data();
    }
    writes.push_back(write);
  }
  device_.vk().vkUpdateDescriptorSets(device_.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                                      nullptr);
  return set;
}

// One descriptor a page; those that a small buffer leaves over repeat the first.
std::vector<VkDescriptorBufferInfo> GraphExecutor::describe_pages(const BoundResource& resource) const {
  const BufferBinding& binding = buffers_[resource.use.index];
  const bool is_storage = resource.binding.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  const Pages pages = is_storage ? divide_into_pages({binding.size, resource.binding.stride}, context_.descriptor_range)
                                 : Pages{1, binding.size};
  std::vector<VkDescriptorBufferInfo> infos;
  for (std::uint32_t page = 0; page < resource.binding.count; ++page) {
    const VkDeviceSize first = page < pages.count ? page * pages.bytes : 0;
    infos.push_back({binding.buffer->handle(), binding.offset + first, std::min(pages.bytes, binding.size - first)});
  }
  return infos;
}

// A shared set is written once a frame for all pipelines whose layouts of it are alike.
VkDescriptorSet GraphExecutor::find_shared_set(const FrameGraph& graph, const ShaderPassBase& pass, SetHandle handle,
                                               VkDescriptorSetLayout layout, Slot& slot) {
  VkDescriptorSet& found = slot.shared_sets[{handle.index, layout}];
  if (found != VK_NULL_HANDLE) return found;
  const ResourceSet& set = graph.sets()[handle.index];
  std::vector<BoundResource> bound;
  for (const Reflection* stage : pass.stages) {
    for (const ShaderBinding& b : stage->bindings) {
      const bool is_new = std::none_of(bound.begin(), bound.end(),
                                       [&](const BoundResource& r) { return r.binding.binding == b.binding; });
      if (b.set != set.number || !is_new) continue;
      const auto member =
          std::find_if(set.members.begin(), set.members.end(), [&](const SetMember& m) { return m.binding == b.name; });
      LW_ASSERT(member != set.members.end(), pass.name + ": set " + set.name + " has no '" + b.name + "'");
      ResourceUse use{.kind = b.type == VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR
                                  ? UseKind::kAccelerationStructureRead
                                  : UseKind::kStorageRead};
      use.index = member->buffer ? member->buffer.index : member->structure.index;
      if (member->image) use = {.is_image = true, .index = member->image.index, .kind = UseKind::kSampled};
      bound.push_back({use, b, member->sampler});
    }
  }
  return found = write_descriptors(graph, bound, layout, slot);
}

void GraphExecutor::bind_descriptors(const FrameGraph& graph, const ShaderPassBase& pass, const Pipeline& pipeline,
                                     VkPipelineBindPoint point, Slot& slot, VkCommandBuffer commands) {
  const auto is_bound = [&](const ShaderBinding& b) {
    if (b.set > 0)
      return std::any_of(pass.sets.begin(), pass.sets.end(),
                         [&](SetHandle set) { return graph.sets()[set.index].number == b.set; });
    return std::any_of(pass.bound.begin(), pass.bound.end(),
                       [&](const BoundResource& r) { return r.binding.binding == b.binding; });
  };
  for (const Reflection* stage : pass.stages)
    for (const ShaderBinding& b : stage->bindings)
      LW_ASSERT(is_bound(b), pass.name + ": nothing is bound to '" + b.name + "' of " + stage->kernel);

  const auto bind = [&](std::uint32_t number, VkDescriptorSet set) {
    device_.vk().vkCmdBindDescriptorSets(commands, point, pipeline.layout, number, 1, &set, 0, nullptr);
  };
  bind(0, write_descriptors(graph, pass.bound, pipeline.set_layouts[0], slot));
  for (const SetHandle set : pass.sets) {
    const std::uint32_t number = graph.sets()[set.index].number;
    const VkDescriptorSetLayout layout = pipeline.set_layouts[number];
    if (layout != VK_NULL_HANDLE) bind(number, find_shared_set(graph, pass, set, layout, slot));
  }
}

// ---- kinds of passes ----

void GraphExecutor::record_kind(const FrameGraph& graph, const ComputePass& pass, Slot& slot,
                                VkCommandBuffer commands) {
  const auto& vk = device_.vk();
  const Pipeline& pipeline = *pipelines_.at(&pass);
  vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline);
  bind_descriptors(graph, pass, pipeline, VK_PIPELINE_BIND_POINT_COMPUTE, slot, commands);
  LW_ASSERT(pass.push_data.size >= pass.stages[0]->push_size, pass.name + ": push constants were not given");
  if (pipeline.push_stages != 0)
    vk.vkCmdPushConstants(commands, pipeline.layout, pipeline.push_stages, 0, pass.stages[0]->push_size,
                          pass.push_data.bytes.data());
  if (pass.indirect) {
    const BufferBinding& arguments = buffers_[pass.indirect->first.index];
    vk.vkCmdDispatchIndirect(commands, arguments.buffer->handle(), arguments.offset + pass.indirect->second);
    return;
  }
  const auto& [x, y, z] = pass.groups;
  const auto& limit = device_.limits().maxComputeWorkGroupCount;
  LW_ASSERT(x <= limit[0] && y <= limit[1] && z <= limit[2], pass.name + ": " + std::to_string(x) + "x" +
                                                                 std::to_string(y) + "x" + std::to_string(z) +
                                                                 " workgroups are more than the device allows");
  if (x > 0 && y > 0 && z > 0) vk.vkCmdDispatch(commands, x, y, z);
}

void GraphExecutor::record_kind(const FrameGraph& graph, const RasterPass& pass, Slot& slot, VkCommandBuffer commands) {
  const auto& vk = device_.vk();
  const auto attachment_info = [&](const Attachment& attachment, VkImageLayout layout) {
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = view_of(*images_[attachment.image.index], VK_IMAGE_VIEW_TYPE_2D, attachment.part);
    info.imageLayout = layout;
    info.loadOp = attachment.clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    if (attachment.clear) info.clearValue = *attachment.clear;
    return info;
  };
  std::vector<VkRenderingAttachmentInfo> colors;
  for (const Attachment& color : pass.colors)
    colors.push_back(attachment_info(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL));
  VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  if (pass.depth_attachment)
    depth = attachment_info(*pass.depth_attachment, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
  const Pipeline& pipeline = *pipelines_.at(&pass);
  LW_ASSERT(pass.area[0] > 0 && pass.area[1] > 0, pass.name + ": no attachments and no render area");
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = {{0, 0}, {pass.area[0], pass.area[1]}};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
  rendering.pColorAttachments = colors.data();
  rendering.pDepthAttachment = pass.depth_attachment ? &depth : nullptr;
  vk.vkCmdBeginRendering(commands, &rendering);
  vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.pipeline);
  bind_descriptors(graph, pass, pipeline, VK_PIPELINE_BIND_POINT_GRAPHICS, slot, commands);
  if (pass.indices) {
    const BufferBinding& indices = buffers_[pass.indices.index];
    vk.vkCmdBindIndexBuffer(commands, indices.buffer->handle(), indices.offset, VK_INDEX_TYPE_UINT32);
  }
  for (const DrawCall& draw : pass.draws) record_draw(pass, pipeline, draw, commands);
  vk.vkCmdEndRendering(commands);
}

void GraphExecutor::record_draw(const RasterPass& pass, const Pipeline& pipeline, const DrawCall& draw,
                                VkCommandBuffer commands) {
  const auto& vk = device_.vk();
  const VkRect2D rect = draw.viewport.value_or(VkRect2D{{0, 0}, {pass.area[0], pass.area[1]}});
  const VkViewport viewport{static_cast<float>(rect.offset.x),
                            static_cast<float>(rect.offset.y),
                            static_cast<float>(rect.extent.width),
                            static_cast<float>(rect.extent.height),
                            0.0f,
                            1.0f};
  vk.vkCmdSetViewport(commands, 0, 1, &viewport);
  vk.vkCmdSetScissor(commands, 0, 1, &rect);
  const std::uint32_t push_size = std::max(pass.stages[0]->push_size, pass.stages[1]->push_size);
  LW_ASSERT(draw.push.size >= push_size, pass.name + ": push constants were not given");
  if (push_size > 0)
    vk.vkCmdPushConstants(commands, pipeline.layout, pipeline.push_stages, 0, push_size, draw.push.bytes.data());
  if (draw.indirect) {
    const BufferBinding& arguments = buffers_[draw.indirect->first.index];
    const VkDeviceSize offset = arguments.offset + draw.indirect->second;
    if (pass.indices)
      vk.vkCmdDrawIndexedIndirect(commands, arguments.buffer->handle(), offset, 1, 0);
    else
      vk.vkCmdDrawIndirect(commands, arguments.buffer->handle(), offset, 1, 0);
    return;
  }
  if (draw.count == 0) return;
  if (pass.indices)
    vk.vkCmdDrawIndexed(commands, draw.count, draw.instances, draw.first, 0, draw.first_instance);
  else
    vk.vkCmdDraw(commands, draw.count, draw.instances, draw.first, draw.first_instance);
}

void GraphExecutor::record_kind(const FrameGraph& graph, const BuildPass& pass, Slot&, VkCommandBuffer commands) {
  const BufferBinding& input = buffers_[pass.input.index];
  graph.buffers()[pass.target.index].structure->record_build(
      commands, input.buffer->address() + input.offset, buffers_[pass.scratch.index].buffer->address(), pass.update);
}

void GraphExecutor::record_kind(const FrameGraph&, const FillPass& pass, Slot&, VkCommandBuffer commands) {
  const BufferBinding& target = buffers_[pass.target.index];
  device_.vk().vkCmdFillBuffer(commands, target.buffer->handle(), target.offset, target.size / 4 * 4, pass.value);
}

void GraphExecutor::record_kind(const FrameGraph&, const BufferCopyPass& pass, Slot&, VkCommandBuffer commands) {
  if (pass.size == 0) return;
  const BufferBinding& source = buffers_[pass.source.index];
  const BufferBinding& target = buffers_[pass.target.index];
  const VkBufferCopy region{source.offset + pass.source_offset, target.offset + pass.target_offset, pass.size};
  device_.vk().vkCmdCopyBuffer(commands, source.buffer->handle(), target.buffer->handle(), 1, &region);
}

void GraphExecutor::record_kind(const FrameGraph& graph, const ImageCopyPass& pass, Slot&, VkCommandBuffer commands) {
  const BufferBinding& buffer = buffers_[pass.buffer.index];
  const ImageDesc& desc = graph.images()[pass.image.index].desc;
  const VkImageAspectFlags aspect =
      is_depth_format(desc.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
  std::vector<VkBufferImageCopy> regions;
  VkDeviceSize offset = buffer.offset;
  const std::uint32_t first_mip = pass.to_image ? 0 : pass.from_mip;
  const std::uint32_t end_mip = pass.to_image ? desc.mips : pass.from_mip + 1;
  for (std::uint32_t mip = first_mip; mip < end_mip; ++mip) {
    VkBufferImageCopy region{};
    region.bufferOffset = offset;
    region.imageSubresource = {aspect, mip, 0, desc.layers};
    region.imageExtent = {std::max(1u, desc.width >> mip), std::max(1u, desc.height >> mip),
                          std::max(1u, desc.depth >> mip)};
    regions.push_back(region);
    offset += VkDeviceSize{region.imageExtent.width} * region.imageExtent.height * region.imageExtent.depth *
              desc.layers * texel_size(desc.format);
  }
  const VkImage image = images_[pass.image.index]->handle();
  const auto count = static_cast<std::uint32_t>(regions.size());
  const auto& vk = device_.vk();
  if (pass.to_image)
    vk.vkCmdCopyBufferToImage(commands, buffer.buffer->handle(), image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, count,
                              regions.data());
  else
    vk.vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.buffer->handle(), count,
                              regions.data());
}

}  // namespace lightwell
