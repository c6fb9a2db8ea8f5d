#include "graph/frame_graph.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "gpu/acceleration_structure.h"
#include "gpu/memory.h"
#include "lightwell/error.h"

namespace lightwell {

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

SetHandle FrameGraph::create_set(ResourceSet set) {
  sets_.push_back(std::move(set));
  return {static_cast<std::uint32_t>(sets_.size() - 1)};
}

template <class Kind>
Kind& FrameGraph::add_pass(std::string_view name) {
  Kind& pass = std::get<Kind>(passes_.emplace_back(std::in_place_type<Kind>));
  pass.name = name;
  pass.graph = this;
  pass.number = passes_.size() - 1;
  return pass;
}

ComputePass& FrameGraph::compute(std::string_view name, const KernelCode& code) {
  ComputePass& pass = add_pass<ComputePass>(name);
  pass.codes = {&code};
  pass.stages = {&context_.reflection(code)};
  LW_ASSERT(pass.stages[0]->stage == VK_SHADER_STAGE_COMPUTE_BIT, pass.name + ": not a compute kernel");
  return pass;
}

RasterPass& FrameGraph::raster(std::string_view name, const KernelCode& vertex, const KernelCode& fragment,
                               const RasterState& state) {
  RasterPass& pass = add_pass<RasterPass>(name);
  pass.codes = {&vertex, &fragment};
  pass.stages = {&context_.reflection(vertex), &context_.reflection(fragment)};
  pass.raster = state;
  return pass;
}

void FrameGraph::fill(std::string_view name, BufferHandle& buffer, std::uint32_t value) {
  check_current(buffer, name);
  FillPass& pass = add_pass<FillPass>(name);
  pass.target = buffer;
  pass.value = value;
  pass.add_use({.index = buffer.index, .kind = UseKind::kTransferWrite, .discards = true});
  renew(buffer, pass);
}

BufferCopyPass& FrameGraph::copy(std::string_view name, BufferHandle source, BufferHandle& target, std::uint64_t size,
                                 std::uint64_t source_offset, std::uint64_t target_offset) {
  check_current(source, name);
  check_current(target, name);
  LW_ASSERT(source_offset + size <= desc(source).size && target_offset + size <= desc(target).size,
            std::string(name) + ": copy beyond the end of a buffer");
  BufferCopyPass& pass = add_pass<BufferCopyPass>(name);
  pass.source = source;
  pass.target = target;
  pass.size = size;
  pass.source_offset = source_offset;
  pass.target_offset = target_offset;
  pass.add_use({.index = source.index, .kind = UseKind::kTransferRead});
  pass.add_use({.index = target.index, .kind = UseKind::kTransferWrite, .discards = size == desc(target).size});
  renew(target, pass);
  return pass;
}

BuildPass& FrameGraph::add_build(std::string_view name, AccelerationStructureHandle& target, BufferHandle input) {
  check_current(target, name);
  check_current(input, name);
  const BufferHandle scratch =
      create_buffer("acceleration structure scratch", buffers_[target.index].structure->scratch_size(), 1);
  BuildPass& pass = add_pass<BuildPass>(name);
  pass.target = target;
  pass.input = input;
  pass.scratch = scratch;
  pass.add_use({.index = input.index, .kind = UseKind::kBuildInput});
  pass.add_use({.index = target.index, .kind = UseKind::kAccelerationStructureBuild});
  pass.add_use({.index = scratch.index, .kind = UseKind::kAccelerationStructureBuild, .discards = true});
  BufferHandle memory{target.index, target.version};
  renew(memory, pass);
  target.version = memory.version;
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
  BuildPass& pass = add_build(name, target, input);
  for (const AccelerationStructureHandle bottom : bottom_levels)
    pass.add_use({.index = bottom.index,
                  .kind = UseKind::kAccelerationStructureRead,
                  .stages = VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR});
}

void FrameGraph::copy(std::string_view name, BufferHandle source, ImageHandle& target) {
  check_current(source, name);
  check_current(target, name);
  ImageCopyPass& pass = add_pass<ImageCopyPass>(name);
  pass.buffer = source;
  pass.image = target;
  pass.to_image = true;
  pass.add_use({.index = source.index, .kind = UseKind::kTransferRead});
  pass.add_use({.is_image = true, .index = target.index, .kind = UseKind::kTransferWrite, .discards = true});
  renew(target, pass);
}

ReadbackTicket FrameGraph::read_back(BufferHandle source) {
  check_current(source, "read back");
  const std::uint64_t size = desc(source).size;
  BufferHandle host = add_buffer({"read back " + name(source), {size, 0}, Lifetime::kReadback});
  copy("read back " + name(source), source, host, size);
  return {host.index, size};
}

ReadbackTicket FrameGraph::read_back(ImageHandle source, std::uint32_t mip) {
  check_current(source, "read back");
  const ImageDesc& d = desc(source);
  LW_ASSERT(mip < d.mips, "read back: mip " + std::to_string(mip) + " of " + std::to_string(d.mips));
  const std::uint64_t size = std::uint64_t{std::max(1u, d.width >> mip)} * std::max(1u, d.height >> mip) *
                             std::max(1u, d.depth >> mip) * d.layers * texel_size(d.format);
  const std::string label = "read back " + name(source);
  const BufferHandle host = add_buffer({label, {size, 0}, Lifetime::kReadback});
  ImageCopyPass& pass = add_pass<ImageCopyPass>(label);
  pass.buffer = host;
  pass.image = source;
  pass.from_mip = mip;
  pass.add_use({.is_image = true, .index = source.index, .kind = UseKind::kTransferRead, .part = mip_of(mip)});
  pass.add_use({.index = host.index, .kind = UseKind::kTransferWrite, .discards = true});
  return {host.index, size};
}

void FrameGraph::watch(BufferHandle source, Watcher done) {
  watchers_.emplace_back(read_back(source), std::move(done));
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
const std::string& FrameGraph::name(ImageHandle handle) const {
  return images_.at(handle.index).name;
}

void FrameGraph::renew(BufferHandle& handle, const PassBase& pass) {
  BufferResource& resource = buffers_[handle.index];
  handle.version = ++resource.version;
  resource.last_writer = pass.number;
}

void FrameGraph::renew(ImageHandle& handle, const PassBase& pass) {
  ImageNode& node = images_[handle.index];
  handle.version = ++node.version;
  node.last_writer = pass.number;
}

template <class Handle>
void FrameGraph::check_use(Handle handle, const PassBase& pass) const {
  check_current(handle, pass.name);
  std::size_t writer = 0;
  if constexpr (std::is_same_v<Handle, ImageHandle>)
    writer = images_[handle.index].last_writer;
  else
    writer = buffers_[handle.index].last_writer;
  LW_ASSERT(writer <= pass.number,
            pass.name + " was begun before " + base_of(passes_[writer]).name + ", which writes what it uses");
}

template void FrameGraph::check_use(BufferHandle, const PassBase&) const;
template void FrameGraph::check_use(ImageHandle, const PassBase&) const;
template void FrameGraph::check_use(AccelerationStructureHandle, const PassBase&) const;

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
