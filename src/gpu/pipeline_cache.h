// Pipelines, made when first used and kept: a kernel with the same constants and state is made once a device.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <string>
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

// A compute pipeline has one stage; a graphics pipeline a vertex and a fragment stage, and a state.
struct PipelineRequest {
  std::vector<ShaderStage> stages;
  SpecValues constants;
  GraphicsState state;
};

class PipelineCache {
 public:
  // `file`: where the driver's own cache is kept between runs; "": nowhere.
  PipelineCache(Device& device, std::string file);
  ~PipelineCache();
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  // One pipeline a request, in their order; they live as long as the cache. Those that are missing are made on all
  // cores. Throws InputError if the driver refuses one; the others are kept.
  std::vector<const Pipeline*> find_or_make(std::span<const PipelineRequest> requests);

  // Of all calls so far: how many were made, and the wall time that it took.
  std::size_t made_count() const { return pipelines_.size(); }
  double making_time_ms() const { return making_time_ms_; }

 private:
  struct Key {
    std::array<const std::uint32_t*, 2> codes{};
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

  static Key key_of(const PipelineRequest& request);
  void make_missing(const std::vector<std::pair<Key, const PipelineRequest*>>& missing);
  Pipeline make(const PipelineRequest& request);
  VkDescriptorSetLayout find_set_layout(const SetLayout& bindings);
  void make_layout(std::span<const ShaderStage> stages, Pipeline& pipeline);
  void make_compute(const PipelineRequest& request, Pipeline& pipeline);
  void make_graphics(const PipelineRequest& request, Pipeline& pipeline);
  void destroy(const Pipeline& pipeline);

  Device& device_;
  std::string file_;
  VkPipelineCache driver_cache_ = VK_NULL_HANDLE;
  std::map<Key, Pipeline> pipelines_;
  std::map<SetLayout, VkDescriptorSetLayout> set_layouts_;  // equal ones are the same, so that sets fit all pipelines
  std::mutex set_layouts_mutex_;                            // pipelines are made by several threads
  double making_time_ms_ = 0.0;
};

}  // namespace lightwell
