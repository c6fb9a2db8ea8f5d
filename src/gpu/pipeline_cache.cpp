#include "gpu/pipeline_cache.h"

#include <algorithm>
#include <array>
#include <string>

#include "gpu/device.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

// Values of the constants that this stage knows; the others belong to the pipeline's other stage.
struct Specialization {
  std::vector<VkSpecializationMapEntry> entries;
  std::vector<std::uint32_t> values;
  VkSpecializationInfo info{};

  Specialization(const Reflection& reflection, const SpecValues& constants) {
    for (const auto& [id, value] : constants) {
      const bool known = std::any_of(reflection.spec_constants.begin(), reflection.spec_constants.end(),
                                     [id = id](const SpecConstant& c) { return c.id == id; });
      if (!known) continue;
      entries.push_back({id, static_cast<std::uint32_t>(values.size() * sizeof(std::uint32_t)), sizeof(std::uint32_t)});
      values.push_back(value);
    }
    info = {static_cast<std::uint32_t>(entries.size()), entries.data(), values.size() * sizeof(std::uint32_t),
            values.data()};
  }
};

VkPipelineShaderStageCreateInfo stage_info(VkShaderStageFlagBits stage, VkShaderModule module,
                                           const VkSpecializationInfo& specialization) {
  VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  info.stage = stage;
  info.module = module;
  info.pName = "main";
  info.pSpecializationInfo = &specialization;
  return info;
}

}  // namespace

PipelineCache::~PipelineCache() {
  for (auto& [key, pipeline] : pipelines_) {
    device_.vk().vkDestroyPipeline(device_.handle(), pipeline.pipeline, nullptr);
    device_.vk().vkDestroyPipelineLayout(device_.handle(), pipeline.layout, nullptr);
  }
  for (auto& [bindings, layout] : set_layouts_)
    device_.vk().vkDestroyDescriptorSetLayout(device_.handle(), layout, nullptr);
}

VkShaderModule PipelineCache::make_module(const KernelCode& code) {
  VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  info.codeSize = code.spirv.size_bytes();
  info.pCode = code.spirv.data();
  VkShaderModule module = VK_NULL_HANDLE;
  LW_VK(device_.vk().vkCreateShaderModule(device_.handle(), &info, nullptr, &module));
  return module;
}

VkDescriptorSetLayout PipelineCache::find_set_layout(const SetLayout& bindings) {
  VkDescriptorSetLayout& layout = set_layouts_[bindings];
  if (layout != VK_NULL_HANDLE) return layout;
  std::vector<VkDescriptorSetLayoutBinding> list;
  for (const LayoutBinding& b : bindings) list.push_back({b.binding, b.type, b.count, b.stages, nullptr});
  VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  info.bindingCount = static_cast<std::uint32_t>(list.size());
  info.pBindings = list.data();
  LW_VK(device_.vk().vkCreateDescriptorSetLayout(device_.handle(), &info, nullptr, &layout));
  return layout;
}

void PipelineCache::make_layout(std::span<const ShaderStage> stages, Pipeline& pipeline) {
  std::array<std::map<std::uint32_t, LayoutBinding>, kMaximumSets> sets;
  std::uint32_t set_count = 1;
  std::uint32_t push_size = 0;
  for (const ShaderStage& stage : stages) {
    const Reflection& reflection = *stage.reflection;
    for (const ShaderBinding& b : reflection.bindings) {
      LayoutBinding& layout =
          sets[b.set].try_emplace(b.binding, LayoutBinding{b.binding, b.type, b.count}).first->second;
      LW_ASSERT(layout.type == b.type && layout.count == b.count,
                reflection.kernel + ": binding " + b.name + " clashes");
      // Shared sets have one layout, whoever binds them.
      layout.stages |= b.set == 0 ? VkShaderStageFlags(reflection.stage) : VkShaderStageFlags(VK_SHADER_STAGE_ALL);
      set_count = std::max(set_count, b.set + 1);
    }
    if (reflection.push_size > 0) pipeline.push_stages |= reflection.stage;
    push_size = std::max(push_size, reflection.push_size);
  }
  LW_ASSERT(push_size <= 128, std::string(stages[0].code->name) + ": push constants over 128 bytes");
  for (std::uint32_t set = 0; set < set_count; ++set) {
    SetLayout bindings;
    for (const auto& [number, binding] : sets[set]) bindings.push_back(binding);
    pipeline.set_layouts[set] = find_set_layout(bindings);
  }

  const VkPushConstantRange range{pipeline.push_stages, 0, (push_size + 3) / 4 * 4};
  VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  info.setLayoutCount = set_count;
  info.pSetLayouts = pipeline.set_layouts.data();
  info.pushConstantRangeCount = push_size > 0 ? 1 : 0;
  info.pPushConstantRanges = &range;
  LW_VK(device_.vk().vkCreatePipelineLayout(device_.handle(), &info, nullptr, &pipeline.layout));
}

const Pipeline& PipelineCache::compute(const ShaderStage& stage, const SpecValues& constants) {
  auto [it, added] = pipelines_.try_emplace(Key{stage.code->spirv.data(), nullptr, constants, {}});
  Pipeline& pipeline = it->second;
  if (!added) return pipeline;
  make_layout({&stage, 1}, pipeline);
  const VkShaderModule module = make_module(*stage.code);
  const Specialization specialization(*stage.reflection, constants);
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage = stage_info(VK_SHADER_STAGE_COMPUTE_BIT, module, specialization.info);
  info.layout = pipeline.layout;
  const VkResult result =
      device_.vk().vkCreateComputePipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline.pipeline);
  device_.vk().vkDestroyShaderModule(device_.handle(), module, nullptr);
  check_vk(result, "vkCreateComputePipelines");
  device_.set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline.pipeline), stage.code->name);
  return pipeline;
}

const Pipeline& PipelineCache::graphics(const ShaderStage& vertex, const ShaderStage& fragment,
                                        const SpecValues& constants, const GraphicsState& state) {
  auto [it, added] =
      pipelines_.try_emplace(Key{vertex.code->spirv.data(), fragment.code->spirv.data(), constants, state});
  Pipeline& pipeline = it->second;
  if (!added) return pipeline;
  make_layout(std::array{vertex, fragment}, pipeline);
  const VkShaderModule modules[2] = {make_module(*vertex.code), make_module(*fragment.code)};
  const Specialization specializations[2] = {{*vertex.reflection, constants}, {*fragment.reflection, constants}};
  const VkPipelineShaderStageCreateInfo stages[2] = {
      stage_info(VK_SHADER_STAGE_VERTEX_BIT, modules[0], specializations[0].info),
      stage_info(VK_SHADER_STAGE_FRAGMENT_BIT, modules[1], specializations[1].info)};

  const VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = 1;
  viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.cullMode = VK_CULL_MODE_NONE;
  raster.lineWidth = 1.0f;
  VkPipelineMultisampleStateCreateInfo multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  depth.depthTestEnable = state.depth_format != VK_FORMAT_UNDEFINED;
  depth.depthWriteEnable = VK_TRUE;
  depth.depthCompareOp = state.raster.depth_compare;
  VkPipelineColorBlendAttachmentState attachment{};
  attachment.colorWriteMask = 0xf;
  if (state.raster.blend == Blend::kAdd) {
    attachment.blendEnable = VK_TRUE;
    attachment.srcColorBlendFactor = attachment.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
    attachment.srcAlphaBlendFactor = attachment.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  }
  const std::vector<VkPipelineColorBlendAttachmentState> blends(state.color_formats.size(), attachment);
  VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = static_cast<std::uint32_t>(blends.size());
  blend.pAttachments = blends.data();
  const VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = 2;
  dynamic.pDynamicStates = dynamic_states;
  VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.colorAttachmentCount = static_cast<std::uint32_t>(state.color_formats.size());
  rendering.pColorAttachmentFormats = state.color_formats.data();
  rendering.depthAttachmentFormat = state.depth_format;

  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
  info.stageCount = 2;
  info.pStages = stages;
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &multisample;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = pipeline.layout;
  const VkResult result =
      device_.vk().vkCreateGraphicsPipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline.pipeline);
  for (const VkShaderModule module : modules) device_.vk().vkDestroyShaderModule(device_.handle(), module, nullptr);
  check_vk(result, "vkCreateGraphicsPipelines");
  device_.set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline.pipeline), fragment.code->name);
  return pipeline;
}

}  // namespace lightwell
