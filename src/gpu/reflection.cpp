#include "gpu/reflection.h"

#include <spirv_cross_c.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "lightwell/error.h"

namespace lightwell {

namespace {

struct ContextDeleter {
  void operator()(spvc_context context) const { spvc_context_destroy(context); }
};

void check(spvc_result result, const KernelCode& code, const char* call) {
  LW_ASSERT(result == SPVC_SUCCESS, std::string(code.name) + ": " + call + " failed");
}

ShaderImageKind image_kind(spvc_type type) {
  const bool arrayed = spvc_type_get_image_arrayed(type) != 0;
  switch (spvc_type_get_image_dimension(type)) {
    case SpvDim2D:
      return arrayed ? ShaderImageKind::k2DArray : ShaderImageKind::k2D;
    case SpvDim3D:
      return ShaderImageKind::k3D;
    case SpvDimCube:
      return ShaderImageKind::kCube;
    default:
      return ShaderImageKind::kNone;
  }
}

// Stride of the runtime array that is a storage block's last member, 0 if the block has none.
std::uint32_t runtime_stride(spvc_compiler compiler, spvc_type_id base) {
  spvc_type type = spvc_compiler_get_type_handle(compiler, base);
  const unsigned members = spvc_type_get_num_member_types(type);
  if (members == 0) return 0;
  spvc_type last = spvc_compiler_get_type_handle(compiler, spvc_type_get_member_type(type, members - 1));
  if (spvc_type_get_num_array_dimensions(last) == 0) return 0;
  unsigned stride = 0;
  spvc_compiler_type_struct_member_array_stride(compiler, type, members - 1, &stride);
  return stride;
}

class Reflector {
 public:
  explicit Reflector(const KernelCode& code) : code_(code) {
    spvc_context context = nullptr;
    check(spvc_context_create(&context), code, "spvc_context_create");
    context_.reset(context);
    spvc_parsed_ir ir = nullptr;
    check(spvc_context_parse_spirv(context, code.spirv.data(), code.spirv.size(), &ir), code, "parse_spirv");
    check(spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler_),
          code, "create_compiler");
    check(spvc_compiler_create_shader_resources(compiler_, &resources_), code, "create_shader_resources");
  }

  Reflection run() {
    result_.kernel = code_.name;
    read_stage();
    add_bindings(SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
    add_bindings(SPVC_RESOURCE_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    add_bindings(SPVC_RESOURCE_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    add_bindings(SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    add_bindings(SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
    add_bindings(SPVC_RESOURCE_TYPE_ACCELERATION_STRUCTURE, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR);
    std::sort(result_.bindings.begin(), result_.bindings.end(), [](const ShaderBinding& a, const ShaderBinding& b) {
      return std::pair(a.set, a.binding) < std::pair(b.set, b.binding);
    });
    read_push_constants();
    read_spec_constants();
    return std::move(result_);
  }

 private:
  void read_stage() {
    switch (spvc_compiler_get_execution_model(compiler_)) {
      case SpvExecutionModelVertex:
        result_.stage = VK_SHADER_STAGE_VERTEX_BIT;
        break;
      case SpvExecutionModelFragment:
        result_.stage = VK_SHADER_STAGE_FRAGMENT_BIT;
        break;
      default:
        result_.stage = VK_SHADER_STAGE_COMPUTE_BIT;
        for (unsigned i = 0; i < 3; ++i)
          result_.workgroup[i] =
              spvc_compiler_get_execution_mode_argument_by_index(compiler_, SpvExecutionModeLocalSize, i);
    }
  }

  std::span<const spvc_reflected_resource> list(spvc_resource_type type) {
    const spvc_reflected_resource* items = nullptr;
    std::size_t count = 0;
    check(spvc_resources_get_resource_list_for_type(resources_, type, &items, &count), code_, "get_resource_list");
    return {items, count};
  }

  void add_bindings(spvc_resource_type resource_type, VkDescriptorType type) {
    for (const spvc_reflected_resource& resource : list(resource_type)) {
      ShaderBinding binding;
      const char* instance = spvc_compiler_get_name(compiler_, resource.id);
      binding.name = instance && *instance ? instance : resource.name;
      binding.set = spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationDescriptorSet);
      LW_ASSERT(binding.set < kMaximumSets,
                std::string(code_.name) + ": " + binding.name + " is in set " + std::to_string(binding.set));
      binding.binding = spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationBinding);
      binding.type = type;
      spvc_type handle = spvc_compiler_get_type_handle(compiler_, resource.type_id);
      if (spvc_type_get_num_array_dimensions(handle) > 0) binding.count = spvc_type_get_array_dimension(handle, 0);
      if (type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
        binding.writable = !is_readonly_block(resource.id);
        binding.stride = runtime_stride(compiler_, resource.base_type_id);
      } else if (type != VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER && type != VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR) {
        binding.image_kind = image_kind(handle);
        binding.writable = type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE &&
                           !spvc_compiler_has_decoration(compiler_, resource.id, SpvDecorationNonWritable);
      }
      result_.bindings.push_back(std::move(binding));
    }
  }

  // `readonly` on a block arrives as NonWritable on every member.
  bool is_readonly_block(spvc_variable_id id) {
    const SpvDecoration* decorations = nullptr;
    std::size_t count = 0;
    check(spvc_compiler_get_buffer_block_decorations(compiler_, id, &decorations, &count), code_, "block decorations");
    return std::find(decorations, decorations + count, SpvDecorationNonWritable) != decorations + count;
  }

  void read_push_constants() {
    for (const spvc_reflected_resource& block : list(SPVC_RESOURCE_TYPE_PUSH_CONSTANT)) {
      spvc_type type = spvc_compiler_get_type_handle(compiler_, block.base_type_id);
      for (unsigned i = 0; i < spvc_type_get_num_member_types(type); ++i) {
        PushMember member;
        member.name = spvc_compiler_get_member_name(compiler_, block.base_type_id, i);
        check(spvc_compiler_type_struct_member_offset(compiler_, type, i, &member.offset), code_, "member offset");
        std::size_t size = 0;
        check(spvc_compiler_get_declared_struct_member_size(compiler_, type, i, &size), code_, "member size");
        member.size = static_cast<std::uint32_t>(size);
        result_.push_size = std::max(result_.push_size, member.offset + member.size);
        result_.push_members.push_back(std::move(member));
      }
    }
  }

  void read_spec_constants() {
    const spvc_specialization_constant* constants = nullptr;
    std::size_t count = 0;
    check(spvc_compiler_get_specialization_constants(compiler_, &constants, &count), code_, "spec constants");
    for (std::size_t i = 0; i < count; ++i)
      result_.spec_constants.push_back({spvc_compiler_get_name(compiler_, constants[i].id), constants[i].constant_id});
  }

  const KernelCode& code_;
  std::unique_ptr<spvc_context_s, ContextDeleter> context_;
  spvc_compiler compiler_ = nullptr;
  spvc_resources resources_ = nullptr;
  Reflection result_;
};

}  // namespace

Reflection reflect(const KernelCode& code) {
  return Reflector(code).run();
}

}  // namespace lightwell
