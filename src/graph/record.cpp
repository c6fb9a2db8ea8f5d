// GraphExecutor: recording of single passes.
#include <algorithm>
#include <array>

#include "gpu/acceleration_structure.h"
#include "gpu/pipeline_cache.h"
#include "graph/executor.h"
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

}  // namespace

void GraphExecutor::record_pass(const FrameGraph& graph, const Pass& pass, Slot& slot, VkCommandBuffer commands) {
  const InstanceTable& labels = device_.instance_table();
  const bool labelled = labels.vkCmdBeginDebugUtilsLabelEXT && labels.vkCmdEndDebugUtilsLabelEXT;
  if (labelled) {
    VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
    label.pLabelName = pass.name.c_str();
    labels.vkCmdBeginDebugUtilsLabelEXT(commands, &label);
  }
  if (pass.kind == Pass::Kind::kCompute)
    record_dispatch(graph, pass, slot, commands);
  else if (pass.kind == Pass::Kind::kRaster)
    record_raster(graph, pass, slot, commands);
  else if (pass.kind == Pass::Kind::kBuild)
    record_build(graph, pass, commands);
  else
    record_copies(graph, pass, commands);
  if (labelled) labels.vkCmdEndDebugUtilsLabelEXT(commands);
}

VkDescriptorSet GraphExecutor::write_descriptors(const FrameGraph& graph, const Pass& pass,
                                                 VkDescriptorSetLayout layout, Slot& slot) {
  for (const Reflection* stage : pass.stages)
    for (const ShaderBinding& b : stage->bindings)
      LW_ASSERT(std::any_of(pass.bound.begin(), pass.bound.end(),
                            [&](const BoundResource& r) { return r.binding.binding == b.binding; }),
                pass.name + ": nothing is bound to '" + b.name + "' of " + stage->kernel);
  VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  allocate.descriptorPool = slot.descriptors;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  LW_VK(device_.vk().vkAllocateDescriptorSets(device_.handle(), &allocate, &set));

  std::vector<VkDescriptorBufferInfo> buffer_infos(pass.bound.size());
  std::vector<VkDescriptorImageInfo> image_infos(pass.bound.size());
  std::vector<VkWriteDescriptorSetAccelerationStructureKHR> structure_infos(pass.bound.size());
  std::vector<VkWriteDescriptorSet> writes;
  for (std::size_t i = 0; i < pass.bound.size(); ++i) {
    const BoundResource& resource = pass.bound[i];
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.dstBinding = resource.binding.binding;
    write.descriptorCount = 1;
    write.descriptorType = resource.binding.type;
    if (resource.use.is_image) {
      VkDescriptorImageInfo& info = image_infos[i];
      info.imageView = images_[resource.use.index]->view(view_type(resource.binding.image_kind));
      info.imageLayout = describe_use(resource.use).layout;
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
      const BufferBinding& binding = buffers_[resource.use.index];
      LW_ASSERT(resource.binding.type != VK_DESCRIPTOR_TYPE_STORAGE_BUFFER ||
                    binding.size <= device_.limits().maxStorageBufferRange,
                pass.name + ": '" + resource.binding.name + "' exceeds the device's storage buffer range");
      buffer_infos[i] = {binding.buffer->handle(), binding.offset, binding.size};
      write.pBufferInfo = &buffer_infos[i];
    }
    writes.push_back(write);
  }
  device_.vk().vkUpdateDescriptorSets(device_.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                                      nullptr);
  return set;
}

void GraphExecutor::record_dispatch(const FrameGraph& graph, const Pass& pass, Slot& slot, VkCommandBuffer commands) {
  const auto& vk = device_.vk();
  const Pipeline& pipeline = device_.pipelines().compute({pass.codes[0], pass.stages[0]}, pass.constants);
  const VkDescriptorSet set = write_descriptors(graph, pass, pipeline.set_layout, slot);
  vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline);
  vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1, &set, 0, nullptr);
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
  if (x * y * z > 0) vk.vkCmdDispatch(commands, x, y, z);
}

void GraphExecutor::record_raster(const FrameGraph& graph, const Pass& pass, Slot& slot, VkCommandBuffer commands) {
  const auto& vk = device_.vk();
  GraphicsState state;
  state.raster = pass.raster;

  const auto attachment_info = [&](const Attachment& attachment, VkImageLayout layout) {
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = images_[attachment.image.index]->view(VK_IMAGE_VIEW_TYPE_2D, true);
    info.imageLayout = layout;
    info.loadOp = attachment.clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    if (attachment.clear) info.clearValue = *attachment.clear;
    return info;
  };
  std::vector<VkRenderingAttachmentInfo> colors;
  for (const Attachment& color : pass.colors) {
    state.color_formats.push_back(graph.desc(color.image).format);
    colors.push_back(attachment_info(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL));
  }
  VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  if (pass.depth_attachment) {
    state.depth_format = graph.desc(pass.depth_attachment->image).format;
    depth = attachment_info(*pass.depth_attachment, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
  }
  const Pipeline& pipeline = device_.pipelines().graphics({pass.codes[0], pass.stages[0]},
                                                          {pass.codes[1], pass.stages[1]}, pass.constants, state);
  const VkDescriptorSet set = write_descriptors(graph, pass, pipeline.set_layout, slot);

  LW_ASSERT(pass.area[0] > 0 && pass.area[1] > 0, pass.name + ": no attachments and no render area");
  const VkRect2D area{{0, 0}, {pass.area[0], pass.area[1]}};
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = area;
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
  rendering.pColorAttachments = colors.data();
  rendering.pDepthAttachment = pass.depth_attachment ? &depth : nullptr;
  vk.vkCmdBeginRendering(commands, &rendering);
  vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.pipeline);
  vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout, 0, 1, &set, 0, nullptr);
  if (pass.indices) {
    const BufferBinding& indices = buffers_[pass.indices.index];
    vk.vkCmdBindIndexBuffer(commands, indices.buffer->handle(), indices.offset, VK_INDEX_TYPE_UINT32);
  }
  const std::uint32_t push_size = std::max(pass.stages[0]->push_size, pass.stages[1]->push_size);
  for (const DrawCall& draw : pass.draws) {
    const VkRect2D rect = draw.viewport.value_or(area);
    const VkViewport viewport{static_cast<float>(rect.offset.x),
                              static_cast<float>(rect.offset.y),
                              static_cast<float>(rect.extent.width),
                              static_cast<float>(rect.extent.height),
                              0.0f,
                              1.0f};
    vk.vkCmdSetViewport(commands, 0, 1, &viewport);
    vk.vkCmdSetScissor(commands, 0, 1, &rect);
    LW_ASSERT(draw.push.size >= push_size, pass.name + ": push constants were not given");
    if (push_size > 0)
      vk.vkCmdPushConstants(commands, pipeline.layout, pipeline.push_stages, 0, push_size, draw.push.bytes.data());
    if (draw.count == 0) continue;
    if (pass.indices)
      vk.vkCmdDrawIndexed(commands, draw.count, draw.instances, 0, 0, 0);
    else
      vk.vkCmdDraw(commands, draw.count, draw.instances, 0, 0);
  }
  vk.vkCmdEndRendering(commands);
}

void GraphExecutor::record_build(const FrameGraph& graph, const Pass& pass, VkCommandBuffer commands) {
  const BufferBinding& input = buffers_[pass.uses[0].index];
  const BufferBinding& scratch = buffers_[pass.uses[2].index];
  graph.buffers()[pass.uses[1].index].structure->record_build(commands, input.buffer->address() + input.offset,
                                                              scratch.buffer->address(), pass.update);
}

void GraphExecutor::record_copies(const FrameGraph& graph, const Pass& pass, VkCommandBuffer commands) {
  const auto& vk = device_.vk();
  if (pass.kind == Pass::Kind::kFillBuffer) {
    const BufferBinding& target = buffers_[pass.uses[0].index];
    vk.vkCmdFillBuffer(commands, target.buffer->handle(), target.offset, target.size / 4 * 4, pass.fill_value);
    return;
  }
  if (pass.kind == Pass::Kind::kCopyBuffer) {
    const BufferBinding& source = buffers_[pass.uses[0].index];
    const BufferBinding& target = buffers_[pass.uses[1].index];
    const VkBufferCopy region{source.offset + pass.source_offset, target.offset + pass.target_offset, pass.copy_size};
    vk.vkCmdCopyBuffer(commands, source.buffer->handle(), target.buffer->handle(), 1, &region);
    return;
  }
  const bool to_image = pass.kind == Pass::Kind::kCopyBufferToImage;
  const std::uint32_t image_index = pass.uses[to_image ? 1 : 0].index;
  const BufferBinding& buffer = buffers_[pass.uses[to_image ? 0 : 1].index];
  const ImageDesc& desc = graph.images()[image_index].desc;
  std::vector<VkBufferImageCopy> regions;
  VkDeviceSize offset = buffer.offset;
  for (std::uint32_t mip = 0; mip < (to_image ? desc.mips : 1); ++mip) {
    VkBufferImageCopy region{};
    region.bufferOffset = offset;
    region.imageSubresource = {
        static_cast<VkImageAspectFlags>(is_depth_format(desc.format) ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                                     : VK_IMAGE_ASPECT_COLOR_BIT),
        mip, 0, desc.layers};
    region.imageExtent = {std::max(1u, desc.width >> mip), std::max(1u, desc.height >> mip),
                          std::max(1u, desc.depth >> mip)};
    regions.push_back(region);
    offset += VkDeviceSize{region.imageExtent.width} * region.imageExtent.height * region.imageExtent.depth *
              desc.layers * texel_size(desc.format);
  }
  const VkImage image = images_[image_index]->handle();
  if (to_image)
    vk.vkCmdCopyBufferToImage(commands, buffer.buffer->handle(), image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                              static_cast<std::uint32_t>(regions.size()), regions.data());
  else
    vk.vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.buffer->handle(), 1,
                              regions.data());
}

}  // namespace lightwell
