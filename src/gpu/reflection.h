// What a SPIR-V module says of itself: bindings, push constants, specialisation constants, workgroup size.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/kernel_code.h"
#include "gpu/vulkan.h"

namespace lightwell {

enum class ShaderImageKind : std::uint8_t { kNone, k2D, k2DArray, k3D, kCube };

struct ShaderBinding {
  std::string name;  // of the variable; of the block's instance or the block for buffers
  std::uint32_t set = 0;
  std::uint32_t binding = 0;
  std::uint32_t count = 1;  // > 1: an array of blocks, the pages of one buffer
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_MAX_ENUM;
  ShaderImageKind image_kind = ShaderImageKind::kNone;
  bool writable = false;
  std::uint32_t stride = 0;  // of the runtime array that ends a storage block; 0 if there is none
};

struct PushMember {
  std::string name;
  std::uint32_t offset = 0;
  std::uint32_t size = 0;
};

struct SpecConstant {
  std::string name;
  std::uint32_t id = 0;
};

inline constexpr std::uint32_t kMaximumSets = 4;  // 0: a kernel's own; the others are shared (ResourceSet)

struct Reflection {
  std::string kernel;
  VkShaderStageFlagBits stage = VK_SHADER_STAGE_COMPUTE_BIT;
  std::vector<ShaderBinding> bindings;  // by set and binding
  std::vector<PushMember> push_members;
  std::uint32_t push_size = 0;
  std::vector<SpecConstant> spec_constants;
  std::array<std::uint32_t, 3> workgroup{1, 1, 1};
};

// Asserts on modules that break our rules (a set beyond kMaximumSets).
Reflection reflect(const KernelCode& code);

}  // namespace lightwell
