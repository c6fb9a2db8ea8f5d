#include "passes/gpu_scene/static_resources.h"

#include <string>
#include <utility>

#include "gpu/device.h"
#include "lightwell/error.h"

namespace lightwell {

void check_buffer_size(const Device& device, std::string_view name, std::uint64_t bytes) {
  const std::uint64_t most = device.limits().maxStorageBufferRange;
  if (bytes <= most) return;
  throw InputError("scene", std::string(name) + " need " + std::to_string(bytes >> 20) +
                                " MiB, more than this device can address (" + std::to_string(most >> 20) + " MiB)");
}

StaticBuffer make_buffer(Device& device, std::string_view name, std::vector<std::byte> bytes) {
  check_buffer_size(device, name, bytes.size());
  if (bytes.empty()) bytes.resize(64);
  return {std::make_unique<Buffer>(device, name, bytes.size(), MemoryKind::kDevice), std::move(bytes)};
}

StaticImage make_textures(Device& device, std::size_t bucket, TextureBucket&& textures) {
  if (textures.layers > device.limits().maxImageArrayLayers) {
    throw InputError("scene", std::to_string(textures.layers) + " textures of " + std::to_string(textures.side) +
                                  " texels a side are more than this device's " +
                                  std::to_string(device.limits().maxImageArrayLayers));
  }
  if (textures.layers == 0) textures = {.side = 1, .layers = 1, .mips = 1, .texels = {255, 255, 255, 255}};
  const ImageInfo info{.format = VK_FORMAT_R8G8B8A8_SRGB,
                       .width = textures.side,
                       .height = textures.side,
                       .layers = textures.layers,
                       .mips = textures.mips,
                       .array = true};
  const std::string name = "textures " + std::to_string(kTextureSides[bucket]);
  return {std::make_unique<ImageResource>(device, name, info), to_bytes(textures.texels)};
}

BufferHandle import(FrameGraph& graph, StaticBuffer& from) {
  BufferHandle handle = graph.import_buffer(*from.buffer);
  if (!from.pending.empty()) {
    const BufferHandle source = graph.upload_bytes(from.buffer->name() + " upload", from.pending, 0);
    graph.copy("upload " + from.buffer->name(), source, handle, from.pending.size());
    from.pending = {};
  }
  return handle;
}

ImageHandle import(FrameGraph& graph, StaticImage& from) {
  ImageHandle handle = graph.import_image(*from.image);
  if (!from.pending.empty()) {
    const BufferHandle source = graph.upload_bytes(from.image->name() + " upload", from.pending, 0);
    graph.copy("upload " + from.image->name(), source, handle);
    from.pending = {};
  }
  return handle;
}

}  // namespace lightwell
