#include "graph/frame_graph.h"

#include <algorithm>

#include "gpu/acceleration_structure.h"
#include "gpu/memory.h"
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

ShaderImageKind image_kind(const ImageDesc& desc) {
  if (desc.depth > 1) return ShaderImageKind::k3D;
  return desc.layers > 1 || desc.array ? ShaderImageKind::k2DArray : ShaderImageKind::k2D;
}

}  // namespace

std::uint32_t texel_size(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R8_UNORM:
      return 1;
    case VK_FORMAT_R16_SFLOAT:
    case VK_FORMAT_D16_UNORM:
      return 2;
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SRGB:
    case VK_FORMAT_B8G8R8A8_UNORM:
    case VK_FORMAT_R16G16_SFLOAT:
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_D32_SFLOAT:
      return 4;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
    case VK_FORMAT_R32G32_SFLOAT:
    case VK_FORMAT_R32G32_UINT:
      return 8;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
    case VK_FORMAT_R32G32B32A32_UINT:
      return 16;
    default:
      LW_ASSERT(false, "format " + std::to_string(format) + " is unknown to the frame graph");
      return 0;
  }
}

bool is_depth_format(VkFormat format) {
  return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM;
}

const Reflection& GraphContext::reflection(const KernelCode& code) {
  auto [it, added] = reflections_.try_emplace(code.spirv.data());
  if (added) it->second = reflect(code);
  return it->second;
}

// ---- Pass ----

const ShaderBinding& Pass::find_binding(std::string_view binding, bool writes) {
  const ShaderBinding* found = nullptr;
  for (const Reflection* stage : stages)
    for (const ShaderBinding& b : stage->bindings)
      if (b.name == binding && (!found || b.writable)) found = &b;
  LW_ASSERT(found, name + ": no binding '" + std::string(binding) + "' in " + stages.at(0)->kernel);
  LW_ASSERT(writes || !found->writable,
            name + ": '" + std::string(binding) + "' is read only but not `readonly` in the shader");
  LW_ASSERT(!writes || found->writable,
            name + ": '" + std::string(binding) + "' is written but `readonly` in the shader");
  for (const BoundResource& other : bound)
    LW_ASSERT(other.binding.binding != found->binding, name + ": '" + std::string(binding) + "' is bound twice");
  return *found;
}

void Pass::add_use(bool is_image, std::uint32_t index, UseKind use_kind, VkPipelineStageFlags2 stages_mask) {
  uses.push_back({is_image, index, use_kind, stages_mask});
}

namespace {

VkPipelineStageFlags2 stages_that_bind(const Pass& pass, const ShaderBinding& binding) {
  VkPipelineStageFlags2 flags = 0;
  for (const Reflection* stage : pass.stages)
    for (const ShaderBinding& b : stage->bindings)
      if (b.binding == binding.binding) flags |= stage_flags(stage->stage);
  return flags;
}

void check_stride(const Pass& pass, const ShaderBinding& binding, const BufferDesc& desc) {
  LW_ASSERT(desc.stride == 0 || binding.stride == 0 || desc.stride == binding.stride,
            pass.name + ": elements of '" + binding.name + "' are " + std::to_string(desc.stride) +
                " bytes on the host, " + std::to_string(binding.stride) + " in the shader");
}

}  // namespace

Pass& Pass::read(std::string_view binding_name, BufferHandle buffer) {
  graph->check_current(buffer, name);
  const ShaderBinding& b = find_binding(binding_name, false);
  const bool uniform = b.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  LW_ASSERT(uniform || b.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, name + ": '" + b.name + "' is not a buffer");
  check_stride(*this, b, graph->desc(buffer));
  const ResourceUse use{false, buffer.index, uniform ? UseKind::kUniformRead : UseKind::kStorageRead,
                        stages_that_bind(*this, b)};
  bound.push_back({use, b});
  uses.push_back(use);
  return *this;
}

Pass& Pass::read(std::string_view binding_name, ImageHandle image, SamplerKind sampler) {
  graph->check_current(image, name);
  const ShaderBinding& b = find_binding(binding_name, false);
  LW_ASSERT(b.image_kind == image_kind(graph->desc(image)),
            name + ": '" + b.name + "' has another dimension than image " + graph->images()[image.index].name);
  const bool storage = b.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
  const ResourceUse use{true, image.index, storage ? UseKind::kStorageRead : UseKind::kSampled,
                        stages_that_bind(*this, b)};
  bound.push_back({use, b, sampler});
  uses.push_back(use);
  return *this;
}

Pass& Pass::read(std::string_view binding_name, AccelerationStructureHandle structure) {
  graph->check_current(structure, name);
  const ShaderBinding& b = find_binding(binding_name, false);
  LW_ASSERT(b.type == VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR,
            name + ": '" + b.name + "' is not an acceleration structure");
  const ResourceUse use{false, structure.index, UseKind::kAccelerationStructureRead, stages_that_bind(*this, b)};
  bound.push_back({use, b});
  uses.push_back(use);
  return *this;
}

Pass& Pass::write(std::string_view binding_name, BufferHandle& buffer) {
  graph->check_current(buffer, name);
  const ShaderBinding& b = find_binding(binding_name, true);
  LW_ASSERT(b.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, name + ": '" + b.name + "' is not a storage buffer");
  check_stride(*this, b, graph->desc(buffer));
  const ResourceUse use{false, buffer.index, UseKind::kStorageWrite, stages_that_bind(*this, b)};
  bound.push_back({use, b});
  uses.push_back(use);
  buffer.version = ++graph->buffers_[buffer.index].version;
  return *this;
}

Pass& Pass::write(std::string_view binding_name, ImageHandle& image) {
  graph->check_current(image, name);
  const ShaderBinding& b = find_binding(binding_name, true);
  LW_ASSERT(b.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, name + ": '" + b.name + "' is not a storage image");
  LW_ASSERT(b.image_kind == image_kind(graph->desc(image)), name + ": '" + b.name + "' has another dimension");
  const ResourceUse use{true, image.index, UseKind::kStorageWrite, stages_that_bind(*this, b)};
  bound.push_back({use, b});
  uses.push_back(use);
  image.version = ++graph->images_[image.index].version;
  return *this;
}

Pass& Pass::constant(std::string_view constant_name, std::uint32_t value) {
  for (const Reflection* stage : stages)
    for (const SpecConstant& c : stage->spec_constants)
      if (c.name == constant_name) {
        constants.emplace_back(c.id, value);
        return *this;
      }
  LW_ASSERT(false, name + ": no specialisation constant '" + std::string(constant_name) + "'");
  return *this;
}

Pass& Pass::push_bytes(std::span<const std::byte> bytes, std::span<const ParamMember> members) {
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
  return *this;
}

void Pass::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  groups = {x, y, z};
}

void Pass::dispatch_threads(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const auto& size = stages.at(0)->workgroup;
  dispatch((x + size[0] - 1) / size[0], (y + size[1] - 1) / size[1], (z + size[2] - 1) / size[2]);
}

void Pass::dispatch_indirect(BufferHandle arguments, std::uint64_t offset) {
  graph->check_current(arguments, name);
  indirect = {arguments, offset};
  add_use(false, arguments.index, UseKind::kIndirectRead, 0);
}

Pass& Pass::color(ImageHandle& image, std::optional<VkClearColorValue> clear) {
  graph->check_current(image, name);
  add_use(true, image.index, UseKind::kColorAttachment, 0);
  image.version = ++graph->images_[image.index].version;
  Attachment attachment{image, {}};
  if (clear) attachment.clear = VkClearValue{.color = *clear};
  colors.push_back(attachment);
  return render_area(graph->desc(image).width, graph->desc(image).height);
}

Pass& Pass::depth(ImageHandle& image, std::optional<float> clear) {
  graph->check_current(image, name);
  LW_ASSERT(is_depth_format(graph->desc(image).format), name + ": depth attachment of a colour format");
  add_use(true, image.index, UseKind::kDepthAttachment, 0);
  image.version = ++graph->images_[image.index].version;
  depth_attachment = Attachment{image, {}};
  if (clear) depth_attachment->clear = VkClearValue{.depthStencil = {*clear, 0}};
  return render_area(graph->desc(image).width, graph->desc(image).height);
}

Pass& Pass::render_area(std::uint32_t width, std::uint32_t height) {
  LW_ASSERT((area[0] == 0 && area[1] == 0) || (area[0] == width && area[1] == height),
            name + ": attachments differ in size");
  area = {width, height};
  return *this;
}

Pass& Pass::index_buffer(BufferHandle buffer) {
  graph->check_current(buffer, name);
  indices = buffer;
  add_use(false, buffer.index, UseKind::kIndexRead, 0);
  return *this;
}

Pass& Pass::draw(std::uint32_t count, std::uint32_t instances) {
  draws.push_back({count, instances, {}, push_data});
  return *this;
}

// ---- FrameGraph ----

BufferHandle FrameGraph::add_buffer(BufferResource resource) {
  buffers_.push_back(std::move(resource));
  return {static_cast<std::uint32_t>(buffers_.size() - 1), 0};
}

ImageHandle FrameGraph::add_image(ImageNode node) {
  images_.push_back(std::move(node));
  return {static_cast<std::uint32_t>(images_.size() - 1), 0};
}

BufferHandle FrameGraph::create_buffer(std::string_view name, std::uint64_t count, std::uint32_t stride) {
  return add_buffer({std::string(name), {std::max<std::uint64_t>(count, 1) * stride, stride}});
}

ImageHandle FrameGraph::create_image(std::string_view name, const ImageDesc& desc) {
  LW_ASSERT(desc.format != VK_FORMAT_UNDEFINED, std::string(name) + ": image without a format");
  return add_image({std::string(name), desc});
}

BufferHandle FrameGraph::history_buffer(std::string_view name, std::uint64_t count, std::uint32_t stride, bool& fresh) {
  const BufferDesc desc{std::max<std::uint64_t>(count, 1) * stride, stride};
  for (const BufferResource& b : buffers_)
    LW_ASSERT(b.lifetime != Lifetime::kHistory || b.name != name, b.name + ": this history is asked for twice");
  auto [it, added] = context_.history_buffers.try_emplace(std::string(name), desc);
  fresh = added || !(it->second == desc);
  it->second = desc;
  return add_buffer({std::string(name), desc, Lifetime::kHistory});
}

ImageHandle FrameGraph::history_image(std::string_view name, const ImageDesc& desc, bool& fresh) {
  for (const ImageNode& i : images_)
    LW_ASSERT(i.lifetime != Lifetime::kHistory || i.name != name, i.name + ": this history is asked for twice");
  auto [it, added] = context_.history_images.try_emplace(std::string(name), desc);
  fresh = added || !(it->second == desc);
  it->second = desc;
  return add_image({std::string(name), desc, Lifetime::kHistory});
}

BufferHandle FrameGraph::import_buffer(Buffer& buffer, std::uint32_t stride) {
  BufferResource resource{buffer.name(), {buffer.size(), stride}, Lifetime::kImported};
  resource.imported = &buffer;
  return add_buffer(std::move(resource));
}

ImageHandle FrameGraph::import_image(ImageResource& image, std::optional<VkImageLayout> final_layout) {
  const ImageInfo& info = image.info();
  ImageNode node{image.name(),
                 {info.width, info.height, info.depth, info.layers, info.mips, info.format, info.array},
                 Lifetime::kImported};
  node.imported = &image;
  node.final_layout = final_layout;
  return add_image(std::move(node));
}

AccelerationStructureHandle FrameGraph::import_acceleration_structure(AccelerationStructure& structure) {
  BufferResource resource{structure.name(), {}, Lifetime::kImported};
  resource.imported = structure.storage();
  resource.structure = &structure;
  return {add_buffer(std::move(resource)).index, 0};
}

BufferHandle FrameGraph::upload_bytes(std::string_view name, std::span<const std::byte> bytes, std::uint32_t stride) {
  BufferResource resource{std::string(name), {std::max<std::uint64_t>(bytes.size(), 16), stride}, Lifetime::kUpload};
  resource.data.assign(bytes.begin(), bytes.end());
  return add_buffer(std::move(resource));
}

Pass& FrameGraph::add_pass(std::string_view name, Pass::Kind kind) {
  Pass& pass = passes_.emplace_back();
  pass.name = name;
  pass.kind = kind;
  pass.graph = this;
  return pass;
}

Pass& FrameGraph::compute(std::string_view name, const KernelCode& code) {
  Pass& pass = add_pass(name, Pass::Kind::kCompute);
  pass.codes = {&code};
  pass.stages = {&context_.reflection(code)};
  LW_ASSERT(pass.stages[0]->stage == VK_SHADER_STAGE_COMPUTE_BIT, pass.name + ": not a compute kernel");
  return pass;
}

Pass& FrameGraph::raster(std::string_view name, const KernelCode& vertex, const KernelCode& fragment,
                         const RasterState& state) {
  Pass& pass = add_pass(name, Pass::Kind::kRaster);
  pass.codes = {&vertex, &fragment};
  pass.stages = {&context_.reflection(vertex), &context_.reflection(fragment)};
  pass.raster = state;
  return pass;
}

void FrameGraph::fill(std::string_view name, BufferHandle& buffer, std::uint32_t value) {
  check_current(buffer, name);
  Pass& pass = add_pass(name, Pass::Kind::kFillBuffer);
  pass.fill_value = value;
  pass.add_use(false, buffer.index, UseKind::kTransferWrite, 0);
  buffer.version = ++buffers_[buffer.index].version;
}

void FrameGraph::copy(std::string_view name, BufferHandle source, BufferHandle& target, std::uint64_t size,
                      std::uint64_t source_offset, std::uint64_t target_offset) {
  check_current(source, name);
  check_current(target, name);
  LW_ASSERT(source_offset + size <= desc(source).size && target_offset + size <= desc(target).size,
            std::string(name) + ": copy beyond the end of a buffer");
  if (size == 0) return;
  Pass& pass = add_pass(name, Pass::Kind::kCopyBuffer);
  pass.copy_size = size;
  pass.source_offset = source_offset;
  pass.target_offset = target_offset;
  pass.add_use(false, source.index, UseKind::kTransferRead, 0);
  pass.add_use(false, target.index, UseKind::kTransferWrite, 0);
  target.version = ++buffers_[target.index].version;
}

Pass& FrameGraph::add_build(std::string_view name, AccelerationStructureHandle& target, BufferHandle input) {
  check_current(target, name);
  check_current(input, name);
  const BufferHandle scratch =
      create_buffer("acceleration structure scratch", buffers_[target.index].structure->scratch_size(), 1);
  Pass& pass = add_pass(name, Pass::Kind::kBuild);
  pass.add_use(false, input.index, UseKind::kBuildInput, 0);
  pass.add_use(false, target.index, UseKind::kAccelerationStructureBuild, 0);
  pass.add_use(false, scratch.index, UseKind::kAccelerationStructureBuild, 0);
  target.version = ++buffers_[target.index].version;
  return pass;
}

void FrameGraph::build(std::string_view name, AccelerationStructureHandle& target, BufferHandle corners, bool update) {
  add_build(name, target, corners).update = update;
}

void FrameGraph::build(std::string_view name, AccelerationStructureHandle& target,
                       std::span<const AccelerationStructureHandle> bottom_levels) {
  std::vector<VkAccelerationStructureInstanceKHR> instances;
  for (const AccelerationStructureHandle bottom : bottom_levels) {
    check_current(bottom, name);
    VkAccelerationStructureInstanceKHR instance{};
    for (int i = 0; i < 3; ++i) instance.transform.matrix[i][i] = 1.0f;
    instance.instanceCustomIndex = static_cast<std::uint32_t>(instances.size()) & 0xffffffu;
    instance.mask = 0xff;
    instance.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
    instance.accelerationStructureReference = buffers_[bottom.index].structure->address();
    instances.push_back(instance);
  }
  const BufferHandle input = upload<VkAccelerationStructureInstanceKHR>("acceleration structure instances", instances);
  Pass& pass = add_build(name, target, input);
  for (const AccelerationStructureHandle bottom : bottom_levels)
    pass.add_use(false, bottom.index, UseKind::kAccelerationStructureRead,
                 VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR);
}

void FrameGraph::copy(std::string_view name, BufferHandle source, ImageHandle& target) {
  check_current(source, name);
  check_current(target, name);
  Pass& pass = add_pass(name, Pass::Kind::kCopyBufferToImage);
  pass.add_use(false, source.index, UseKind::kTransferRead, 0);
  pass.add_use(true, target.index, UseKind::kTransferWrite, 0);
  target.version = ++images_[target.index].version;
}

void FrameGraph::notify_recorded() {
  for (const std::function<void()>& done : on_recorded_) done();
}

ReadbackTicket FrameGraph::read_back(BufferHandle source) {
  check_current(source, "read back");
  const std::uint64_t size = desc(source).size;
  const BufferHandle host = add_buffer({"read back " + name(source), {size, 0}, Lifetime::kReadback});
  Pass& pass = add_pass("read back " + name(source), Pass::Kind::kCopyBuffer);
  pass.copy_size = size;
  pass.add_use(false, source.index, UseKind::kTransferRead, 0);
  pass.add_use(false, host.index, UseKind::kTransferWrite, 0);
  return {host.index, size};
}

ReadbackTicket FrameGraph::read_back(ImageHandle source) {
  check_current(source, "read back");
  const ImageNode& node = images_[source.index];
  const std::uint64_t size = std::uint64_t{node.desc.width} * node.desc.height * node.desc.depth * node.desc.layers *
                             texel_size(node.desc.format);
  const BufferHandle host = add_buffer({"read back " + node.name, {size, 0}, Lifetime::kReadback});
  Pass& pass = add_pass("read back " + node.name, Pass::Kind::kCopyImageToBuffer);
  pass.add_use(true, source.index, UseKind::kTransferRead, 0);
  pass.add_use(false, host.index, UseKind::kTransferWrite, 0);
  return {host.index, size};
}

const BufferDesc& FrameGraph::desc(BufferHandle handle) const {
  return buffers_.at(handle.index).desc;
}
const ImageDesc& FrameGraph::desc(ImageHandle handle) const {
  return images_.at(handle.index).desc;
}
const std::string& FrameGraph::name(BufferHandle handle) const {
  return buffers_.at(handle.index).name;
}

void FrameGraph::check_current(AccelerationStructureHandle handle, std::string_view pass) const {
  check_current(BufferHandle{handle.index, handle.version}, pass);
}

void FrameGraph::check_current(BufferHandle handle, std::string_view pass) const {
  LW_ASSERT(handle && handle.index < buffers_.size(),
            std::string(pass) + ": a buffer handle that is empty or not of this frame");
  const BufferResource& resource = buffers_[handle.index];
  LW_ASSERT(handle.version == resource.version, std::string(pass) + ": stale handle of " + resource.name +
                                                    ": version " + std::to_string(handle.version) +
                                                    " was overwritten by version " + std::to_string(resource.version));
}

void FrameGraph::check_current(ImageHandle handle, std::string_view pass) const {
  LW_ASSERT(handle && handle.index < images_.size(),
            std::string(pass) + ": an image handle that is empty or not of this frame");
  const ImageNode& node = images_[handle.index];
  LW_ASSERT(handle.version == node.version, std::string(pass) + ": stale handle of " + node.name + ": version " +
                                                std::to_string(handle.version) + " was overwritten by version " +
                                                std::to_string(node.version));
}

}  // namespace lightwell
