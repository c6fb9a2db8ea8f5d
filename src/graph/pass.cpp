#include "graph/pass.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "graph/frame_graph.h"
#include "graph/pages.h"
#include "lightwell/error.h"

namespace lightwell {
namespace {

VkPipelineStageFlags2 stage_flags(VkShaderStageFlagBits stage) {
  switch (stage) {
    case VK_SHADER_STAGE_VERTEX_BIT:
      return VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
    case VK_SHADER_STAGE_FRAGMENT_BIT:
      return VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    default:
      return VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  }
}

ShaderImageKind image_kind(const ImageDesc& desc, Subresource part) {
  if (desc.depth > 1) return ShaderImageKind::k3D;
  const bool is_array = (desc.layers > 1 || desc.array) && part.layer == Subresource::kAll;
  return is_array ? ShaderImageKind::k2DArray : ShaderImageKind::k2D;
}

VkPipelineStageFlags2 stages_that_bind(const ShaderPassBase& pass, const ShaderBinding& binding) {
  VkPipelineStageFlags2 flags = 0;
  for (const Reflection* stage : pass.stages)
    for (const ShaderBinding& b : stage->bindings)
      if (b.set == binding.set && b.binding == binding.binding) flags |= stage_flags(stage->stage);
  return flags;
}

void check_stride(const std::string& pass, const ShaderBinding& binding, const BufferDesc& desc) {
  LW_ASSERT(desc.stride == 0 || binding.stride == 0 || desc.stride == binding.stride,
            pass + ": elements of '" + binding.name + "' are " + std::to_string(desc.stride) + " bytes on the host, " +
                std::to_string(binding.stride) + " in the shader");
}

// What the shader's declaration asks of a resource that it only reads.
ResourceUse read_use(const std::string& pass, const FrameGraph& graph, const ShaderBinding& b, BufferHandle buffer) {
  const bool uniform = b.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  LW_ASSERT(uniform || b.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, pass + ": '" + b.name + "' is not a buffer");
  check_stride(pass, b, graph.desc(buffer));
  return {.index = buffer.index, .kind = uniform ? UseKind::kUniformRead : UseKind::kStorageRead};
}

void check_part(const std::string& pass, const ImageDesc& desc, Subresource part) {
  LW_ASSERT(part.mip == Subresource::kAll || part.mip < desc.mips,
            pass + ": mip " + std::to_string(part.mip) + " of " + std::to_string(desc.mips));
  LW_ASSERT(part.layer == Subresource::kAll || part.layer < desc.layers,
            pass + ": layer " + std::to_string(part.layer) + " of " + std::to_string(desc.layers));
}

// The only mip or layer is all of them.
Subresource normalize(const ImageDesc& desc, Subresource part) {
  return {desc.mips == 1 ? Subresource::kAll : part.mip, desc.layers == 1 ? Subresource::kAll : part.layer};
}

ResourceUse read_use(const std::string& pass, const FrameGraph& graph, const ShaderBinding& b, ImageHandle image,
                     Subresource part) {
  check_part(pass, graph.desc(image), part);
  LW_ASSERT(b.image_kind == image_kind(graph.desc(image), part),
            pass + ": '" + b.name + "' has another dimension than image " + graph.name(image));
  const bool storage = b.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
  return {.is_image = true,
          .index = image.index,
          .kind = storage ? UseKind::kStorageRead : UseKind::kSampled,
          .part = normalize(graph.desc(image), part)};
}

ResourceUse read_use(const std::string& pass, const ShaderBinding& b, AccelerationStructureHandle structure) {
  LW_ASSERT(b.type == VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR,
            pass + ": '" + b.name + "' is not an acceleration structure");
  return {.index = structure.index, .kind = UseKind::kAccelerationStructureRead};
}

}  // namespace

const ShaderPassBase* shader_pass(const Pass& pass) {
  if (const auto* compute = std::get_if<ComputePass>(&pass)) return compute;
  return std::get_if<RasterPass>(&pass);
}

// ---- binding ----

const ShaderBinding& ShaderPassBase::find_binding(std::string_view binding, bool writes) {
  const ShaderBinding* found = nullptr;
  for (const Reflection* stage : stages)
    for (const ShaderBinding& b : stage->bindings)
      if (b.set == 0 && b.name == binding && (!found || b.writable)) found = &b;
  LW_ASSERT(found, name + ": no binding '" + std::string(binding) + "' in " + stages.at(0)->kernel);
  LW_ASSERT(writes || !found->writable,
            name + ": '" + std::string(binding) + "' is read only but not `readonly` in the shader");
  LW_ASSERT(!writes || found->writable,
            name + ": '" + std::string(binding) + "' is written but `readonly` in the shader");
  for (const BoundResource& other : bound)
    LW_ASSERT(other.binding.binding != found->binding, name + ": '" + std::string(binding) + "' is bound twice");
  return *found;
}

// An array of blocks takes the buffer in pages; the shader's constants kPages_<binding> and kPageShift_<binding> say
// how many there are and which bits of an index are the page's.
void ShaderPassBase::set_page_count(const ShaderBinding& binding, BufferHandle buffer) {
  if (binding.type != VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) return;
  const std::uint64_t size = graph->desc(buffer).size;
  const Pages pages = divide_into_pages({size, binding.stride}, graph->descriptor_range());
  if (pages.count > binding.count) {
    const std::uint64_t most = binding.count == 1 ? graph->descriptor_range() : binding.count * pages.bytes;
    throw InputError("scene", graph->name(buffer) + " need " + std::to_string(size >> 20) + " MiB; on this device '" +
                                  name + "' reaches " + std::to_string(most >> 20) + " MiB");
  }
  if (binding.count == 1) return;
  try_constant("kPages_" + binding.name, static_cast<std::uint32_t>(pages.count));
  try_constant("kPageShift_" + binding.name, pages.shift);
}

void ShaderPassBase::bind_buffer(std::string_view binding, BufferHandle buffer) {
  graph->check_use(buffer, *this);
  const ShaderBinding& b = find_binding(binding, false);
  ResourceUse use = read_use(name, *graph, b, buffer);
  use.stages = stages_that_bind(*this, b);
  set_page_count(b, buffer);
  bound.push_back({use, b});
  add_use(use);
}

void ShaderPassBase::bind_image(std::string_view binding, ImageHandle image, SamplerKind sampler, Subresource part) {
  graph->check_use(image, *this);
  const ShaderBinding& b = find_binding(binding, false);
  ResourceUse use = read_use(name, *graph, b, image, part);
  use.stages = stages_that_bind(*this, b);
  bound.push_back({use, b, sampler});
  add_use(use);
}

void ShaderPassBase::bind_structure(std::string_view binding, AccelerationStructureHandle structure) {
  graph->check_use(structure, *this);
  const ShaderBinding& b = find_binding(binding, false);
  ResourceUse use = read_use(name, b, structure);
  use.stages = stages_that_bind(*this, b);
  bound.push_back({use, b});
  add_use(use);
}

void ShaderPassBase::bind_written(std::string_view binding, BufferHandle& buffer) {
  graph->check_use(buffer, *this);
  const ShaderBinding& b = find_binding(binding, true);
  LW_ASSERT(b.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, name + ": '" + b.name + "' is not a storage buffer");
  check_stride(name, b, graph->desc(buffer));
  set_page_count(b, buffer);
  const ResourceUse use{.index = buffer.index, .kind = UseKind::kStorageWrite, .stages = stages_that_bind(*this, b)};
  bound.push_back({use, b});
  add_use(use);
  graph->renew(buffer, *this);
}

void ShaderPassBase::bind_written(std::string_view binding, ImageHandle& image, Subresource part) {
  graph->check_use(image, *this);
  check_part(name, graph->desc(image), part);
  const ShaderBinding& b = find_binding(binding, true);
  LW_ASSERT(b.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, name + ": '" + b.name + "' is not a storage image");
  LW_ASSERT(b.image_kind == image_kind(graph->desc(image), part), name + ": '" + b.name + "' has another dimension");
  // A storage image shows one mip.
  if (part.mip == Subresource::kAll) part.mip = 0;
  const ResourceUse use{.is_image = true,
                        .index = image.index,
                        .kind = UseKind::kStorageWrite,
                        .stages = stages_that_bind(*this, b),
                        .part = normalize(graph->desc(image), part)};
  bound.push_back({use, b});
  add_use(use);
  graph->renew(image, *this);
}

// Uses are noted for what the shader declares of the set; its members must be current then.
void ShaderPassBase::bind_set(SetHandle handle) {
  const ResourceSet& set = graph->sets().at(handle.index);
  for (const SetHandle other : sets)
    LW_ASSERT(graph->sets()[other.index].number != set.number, name + ": set " + set.name + " is bound twice");
  sets.push_back(handle);
  for (const SetMember& member : set.members) {
    const ShaderBinding* b = nullptr;
    for (const Reflection* stage : stages)
      for (const ShaderBinding& candidate : stage->bindings)
        if (candidate.set == set.number && candidate.name == member.binding) b = &candidate;
    if (b == nullptr) continue;
    LW_ASSERT(!b->writable, name + ": '" + b->name + "' of set " + set.name + " is not `readonly` in the shader");
    ResourceUse use;
    if (member.buffer) {
      graph->check_use(member.buffer, *this);
      use = read_use(name, *graph, *b, member.buffer);
      set_page_count(*b, member.buffer);
    } else if (member.image) {
      graph->check_use(member.image, *this);
      use = read_use(name, *graph, *b, member.image, kWholeImage);
    } else {
      graph->check_use(member.structure, *this);
      use = read_use(name, *b, member.structure);
    }
    use.stages = stages_that_bind(*this, *b);
    add_use(use);
  }
  for (const auto& [constant, value] : set.constants) try_constant(constant, value);
}

bool ShaderPassBase::try_constant(std::string_view constant, std::uint32_t value) {
  for (const Reflection* stage : stages)
    for (const SpecConstant& c : stage->spec_constants)
      if (c.name == constant) {
        constants.emplace_back(c.id, value);
        return true;
      }
  return false;
}

void ShaderPassBase::set_constant(std::string_view constant, std::uint32_t value) {
  LW_ASSERT(try_constant(constant, value), name + ": no specialisation constant '" + std::string(constant) + "'");
}

void ShaderPassBase::push_bytes(std::span<const std::byte> bytes, std::span<const ParamMember> members) {
  LW_ASSERT(bytes.size() <= push_data.bytes.size(), name + ": push constants over 128 bytes");
  bool used = false;
  for (const Reflection* stage : stages) {
    for (const PushMember& shader : stage->push_members) {
      used = true;
      const auto host =
          std::find_if(members.begin(), members.end(), [&](const ParamMember& m) { return shader.name == m.name; });
      LW_ASSERT(host != members.end(), name + ": the shader's parameter '" + shader.name + "' is unknown to the host");
      LW_ASSERT(host->offset == shader.offset && host->size == shader.size,
                name + ": parameter '" + shader.name + "' lies at " + std::to_string(host->offset) + " (" +
                    std::to_string(host->size) + " bytes) on the host, at " + std::to_string(shader.offset) + " (" +
                    std::to_string(shader.size) + " bytes) in the shader");
    }
  }
  LW_ASSERT(used, name + ": the shader has no push constants");
  std::memcpy(push_data.bytes.data(), bytes.data(), bytes.size());
  push_data.size = static_cast<std::uint32_t>(bytes.size());
}

// ---- compute ----

void ComputePass::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  groups = {x, y, z};
}

void ComputePass::dispatch_threads(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const auto& size = stages.at(0)->workgroup;
  dispatch((x + size[0] - 1) / size[0], (y + size[1] - 1) / size[1], (z + size[2] - 1) / size[2]);
}

void ComputePass::dispatch_indirect(BufferHandle arguments, std::uint64_t offset) {
  graph->check_use(arguments, *this);
  indirect = {arguments, offset};
  add_use({.index = arguments.index, .kind = UseKind::kIndirectRead});
}

// ---- raster ----

Attachment RasterPass::attach(ImageHandle& image, UseKind kind, Subresource part, bool clears) {
  graph->check_use(image, *this);
  const ImageDesc& desc = graph->desc(image);
  check_part(name, desc, part);
  const Subresource target{part.mip == Subresource::kAll ? 0 : part.mip,
                           part.layer == Subresource::kAll ? 0 : part.layer};
  add_use({.is_image = true, .index = image.index, .kind = kind, .part = normalize(desc, target), .discards = clears});
  graph->renew(image, *this);
  render_area(std::max(1u, desc.width >> target.mip), std::max(1u, desc.height >> target.mip));
  return {image, target, {}};
}

RasterPass& RasterPass::color(ImageHandle& image, std::optional<VkClearColorValue> clear, Subresource part) {
  colors.push_back(attach(image, UseKind::kColorAttachment, part, clear.has_value()));
  if (clear) colors.back().clear = VkClearValue{.color = *clear};
  return *this;
}

RasterPass& RasterPass::depth(ImageHandle& image, std::optional<float> clear, Subresource part) {
  LW_ASSERT(is_depth_format(graph->desc(image).format), name + ": depth attachment of a colour format");
  depth_attachment = attach(image, UseKind::kDepthAttachment, part, clear.has_value());
  if (clear) depth_attachment->clear = VkClearValue{.depthStencil = {*clear, 0}};
  return *this;
}

RasterPass& RasterPass::render_area(std::uint32_t width, std::uint32_t height) {
  LW_ASSERT((area[0] == 0 && area[1] == 0) || (area[0] == width && area[1] == height),
            name + ": attachments differ in size");
  area = {width, height};
  return *this;
}

RasterPass& RasterPass::index_buffer(BufferHandle buffer) {
  graph->check_use(buffer, *this);
  indices = buffer;
  add_use({.index = buffer.index, .kind = UseKind::kIndexRead});
  return *this;
}

RasterPass& RasterPass::draw(DrawCall call) {
  call.push = push_data;
  draws.push_back(call);
  return *this;
}

RasterPass& RasterPass::draw_indirect(BufferHandle arguments, std::uint64_t offset) {
  graph->check_use(arguments, *this);
  add_use({.index = arguments.index, .kind = UseKind::kIndirectRead});
  DrawCall call;
  call.indirect = {arguments, offset};
  return draw(call);
}

}  // namespace lightwell
