#include "passes/gpu_scene/static_resources.h"

#include <algorithm>
#include <string>

#include "gpu/device.h"
#include "lightwell/error.h"

namespace lightwell {
namespace {

std::unique_ptr<Buffer> make_staging(Device& device, std::string_view name, std::uint64_t bytes) {
  return std::make_unique<Buffer>(device, std::string(name) + " upload", bytes, MemoryKind::kHostUpload);
}

// Until a frame was really recorded with the copy, the next one must copy too.
template <class Resource>
void release_when_copied(FrameGraph& graph, Resource& resource) {
  graph.on_recorded([&resource] { resource.staging.reset(); });
}

}  // namespace

void check_buffer_size(const Device& device, std::string_view name, std::uint64_t bytes) {
  const std::uint64_t most = device.limits().maxStorageBufferRange;
  if (bytes <= most) return;
  throw InputError("scene", std::string(name) + " need " + std::to_string(bytes >> 20) +
                                " MiB, more than this device can address (" + std::to_string(most >> 20) + " MiB)");
}

StaticBuffer make_buffer(Device& device, std::string_view name, std::span<const std::byte> bytes) {
  StaticBuffer made{std::make_unique<Buffer>(device, name, bytes.size(), MemoryKind::kDevice), nullptr};
  if (bytes.empty()) return made;
  made.staging = make_staging(device, name, bytes.size());
  std::copy(bytes.begin(), bytes.end(), made.staging->mapped());
  return made;
}

StaticImage make_image(Device& device, std::string_view name, const ImageInfo& info, std::uint64_t bytes) {
  return {std::make_unique<ImageResource>(device, name, info), make_staging(device, name, bytes)};
}

StaticImage make_textures(Device& device, std::size_t bucket, const TextureBucket& textures) {
  const bool none = textures.layers == 0;
  const ImageInfo info{.format = VK_FORMAT_R8G8B8A8_SRGB,
                       .width = textures.side,
                       .height = textures.side,
                       .layers = std::max(textures.layers, 1u),
                       .mips = textures.mips,
                       .array = true};
  const std::vector<std::uint8_t> white(4, 255);
  const std::span<const std::byte> texels = as_byte_span(none ? white : textures.texels);
  StaticImage made = make_image(device, "textures " + std::to_string(kTextureSides[bucket]), info, texels.size());
  std::copy(texels.begin(), texels.end(), made.staging->mapped());
  return made;
}

void upload(FrameGraph& graph, BufferHandle& target, std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  const std::string name = graph.name(target);
  graph.copy("upload " + name, graph.upload_bytes(name + " upload", bytes, 0), target, bytes.size());
}

BufferHandle import(FrameGraph& graph, StaticBuffer& from) {
  BufferHandle handle = graph.import_buffer(*from.buffer);
  if (from.staging) {
    graph.copy("upload " + from.buffer->name(), graph.import_buffer(*from.staging), handle, from.staging->size());
    release_when_copied(graph, from);
  }
  return handle;
}

ImageHandle import(FrameGraph& graph, StaticImage& from) {
  ImageHandle handle = graph.import_image(*from.image);
  if (from.staging) {
    graph.copy("upload " + from.image->name(), graph.import_buffer(*from.staging), handle);
    release_when_copied(graph, from);
  }
  return handle;
}

}  // namespace lightwell
