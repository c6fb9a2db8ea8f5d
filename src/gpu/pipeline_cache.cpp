#include "gpu/pipeline_cache.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <exception>
#include <optional>
#include <string>
#include <thread>

#include "gpu/device.h"
#include "gpu/pipeline_cache_file.h"
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

// A compiled stage, needed only while pipelines are made of it.
class ShaderModule {
 public:
  ShaderModule(Device& device, const KernelCode& code) : device_(device) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = code.spirv.size_bytes();
    info.pCode = code.spirv.data();
    LW_VK(device.vk().vkCreateShaderModule(device.handle(), &info, nullptr, &handle_));
  }
  ~ShaderModule() { device_.vk().vkDestroyShaderModule(device_.handle(), handle_, nullptr); }
  ShaderModule(const ShaderModule&) = delete;
  ShaderModule& operator=(const ShaderModule&) = delete;
  VkShaderModule handle() const { return handle_; }

 private:
  Device& device_;
  VkShaderModule handle_ = VK_NULL_HANDLE;
};

// Calls work(0) to work(count - 1) on as many threads as there are cores. `work` does not throw.
template <class Work>
void run_on_all_cores(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next{0};
  const auto take_turns = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> helpers;
  const std::size_t threads = std::min<std::size_t>(count, std::max(1u, std::thread::hardware_concurrency()));
  for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back(take_turns);
  take_turns();
}

}  // namespace

PipelineCache::PipelineCache(Device& device, std::string file) : device_(device), file_(std::move(file)) {
  const std::vector<std::uint8_t> data = read_pipeline_data(file_);
  VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  info.initialDataSize = data.size();
  info.pInitialData = data.data();
  LW_VK(device.vk().vkCreatePipelineCache(device.handle(), &info, nullptr, &driver_cache_));
}

PipelineCache::~PipelineCache() {
  const auto& vk = device_.vk();
  if (!file_.empty() && !pipelines_.empty()) {
    std::size_t size = 0;
    vk.vkGetPipelineCacheData(device_.handle(), driver_cache_, &size, nullptr);
    std::vector<std::uint8_t> data(size);
    if (vk.vkGetPipelineCacheData(device_.handle(), driver_cache_, &size, data.data()) == VK_SUCCESS)
      write_pipeline_data(file_, std::span(data).first(size));
  }
  for (const auto& [key, pipeline] : pipelines_) destroy(pipeline);
  for (const auto& [bindings, layout] : set_layouts_)
    vk.vkDestroyDescriptorSetLayout(device_.handle(), layout, nullptr);
  vk.vkDestroyPipelineCache(device_.handle(), driver_cache_, nullptr);
}

void PipelineCache::destroy(const Pipeline& pipeline) {
  device_.vk().vkDestroyPipeline(device_.handle(), pipeline.pipeline, nullptr);
  device_.vk().vkDestroyPipelineLayout(device_.handle(), pipeline.layout, nullptr);
}

PipelineCache::Key PipelineCache::key_of(const PipelineRequest& request) {
  LW_ASSERT(request.stages.size() == 1 || request.stages.size() == 2, std::to_string(request.stages.size()));
  Key key{{}, request.constants, request.state};
  for (std::size_t i = 0; i < request.stages.size(); ++i) key.codes[i] = request.stages[i].code->spirv.data();
  return key;
}

std::vector<const Pipeline*> PipelineCache::find_or_make(std::span<const PipelineRequest> requests) {
  std::vector<Key> keys;
  std::transform(requests.begin(), requests.end(), std::back_inserter(keys), key_of);
  std::map<Key, const PipelineRequest*> missing;
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (!pipelines_.contains(keys[i])) missing.emplace(keys[i], &requests[i]);
  if (!missing.empty()) make_missing({missing.begin(), missing.end()});
  std::vector<const Pipeline*> found;
  for (const Key& key : keys) found.push_back(&pipelines_.at(key));
  return found;
}

void PipelineCache::make_missing(const std::vector<std::pair<Key, const PipelineRequest*>>& missing) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::optional<Pipeline>> made(missing.size());
  std::vector<std::exception_ptr> errors(missing.size());
  run_on_all_cores(missing.size(), [&](std::size_t i) {
    try {
      made[i] = make(*missing[i].second);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (std::size_t i = 0; i < missing.size(); ++i)
    if (made[i]) pipelines_.emplace(missing[i].first, *made[i]);
  making_time_ms_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

Pipeline PipelineCache::make(const PipelineRequest& request) {
  Pipeline pipeline;
  try {
    make_layout(request.stages, pipeline);
    if (request.stages.size() == 1)
      make_compute(request, pipeline);
    else
      make_graphics(request, pipeline);
  } catch (...) {
    destroy(pipeline);
    throw;
  }
  device_.set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline.pipeline),
                   request.stages.back().code->name);
  return pipeline;
}

VkDescriptorSetLayout PipelineCache::find_set_layout(const SetLayout& bindings) {
  const std::lock_guard lock(set_layouts_mutex_);
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

void PipelineCache::make_compute(const PipelineRequest& request, Pipeline& pipeline) {
  const ShaderModule module(device_, *request.stages[0].code);
  const Specialization specialization(*request.stages[0].reflection, request.constants);
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage = stage_info(VK_SHADER_STAGE_COMPUTE_BIT, module.handle(), specialization.info);
  info.layout = pipeline.layout;
  LW_VK(device_.vk().vkCreateComputePipelines(device_.handle(), driver_cache_, 1, &info, nullptr, &pipeline.pipeline));
}

void PipelineCache::make_graphics(const PipelineRequest& request, Pipeline& pipeline) {
  const GraphicsState& state = request.state;
  const ShaderModule vertex(device_, *request.stages[0].code);
  const ShaderModule fragment(device_, *request.stages[1].code);
  const Specialization specializations[2] = {{*request.stages[0].reflection, request.constants},
                                             {*request.stages[1].reflection, request.constants}};
  const VkPipelineShaderStageCreateInfo stages[2] = {
      stage_info(VK_SHADER_STAGE_VERTEX_BIT, vertex.handle(), specializations[0].info),
      stage_info(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.handle(), specializations[1].info)};

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
  LW_VK(device_.vk().vkCreateGraphicsPipelines(device_.handle(), driver_cache_, 1, &info, nullptr, &pipeline.pipeline));
}

}  // namespace lightwell
