// Pipelines, made when first used and kept: a kernel with the same constants and state is made once a device.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "gpu/kernel_code.h"
#include "gpu/raster_state.h"
#include "gpu/reflection.h"
#include "gpu/vulkan.h"

namespace lightwell {

class Device;

struct GraphicsState {
  std::vector<VkFormat> color_formats;
  VkFormat depth_format = VK_FORMAT_UNDEFINED;
  RasterState raster;
  auto operator<=>(const GraphicsState&) const = default;
};

struct Pipeline {
  VkPipeline pipeline = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  std::array<VkDescriptorSetLayout, kMaximumSets> set_layouts{};  // owned by the cache; null beyond the last set
  VkShaderStageFlags push_stages = 0;
};

struct ShaderStage {
  const KernelCode* code = nullptr;
  const Reflection* reflection = nullptr;
};

using SpecValues = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // constant id, value

class PipelineCache {
 public:
  explicit PipelineCache(Device& device) : device_(device) {}
  ~PipelineCache();

  const Pipeline& compute(const ShaderStage& stage, const SpecValues& constants);
  const Pipeline& graphics(const ShaderStage& vertex, const ShaderStage& fragment, const SpecValues& constants,
                           const GraphicsState& state);

 private:
  struct Key {
    const std::uint32_t* first = nullptr;
    const std::uint32_t* second = nullptr;
    SpecValues constants;
    GraphicsState state;
    auto operator<=>(const Key&) const = default;
  };
  // What decides a set's layout, binding by binding.
  struct LayoutBinding {
    std::uint32_t binding = 0;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_MAX_ENUM;
    std::uint32_t count = 1;
    VkShaderStageFlags stages = 0;
    auto operator<=>(const LayoutBinding&) const = default;
  };
  using SetLayout = std::vector<LayoutBinding>;

  VkDescriptorSetLayout find_set_layout(const SetLayout& bindings);
  void make_layout(std::span<const ShaderStage> stages, Pipeline& pipeline);
  VkShaderModule make_module(const KernelCode& code);

  Device& device_;
  std::map<Key, Pipeline> pipelines_;
  std::map<SetLayout, VkDescriptorSetLayout> set_layouts_;  // equal ones are the same, so that sets fit all pipelines
};

}  // namespace lightwell
