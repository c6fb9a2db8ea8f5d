// Buffers and images of the GPU that the host fills now and then: their bytes travel with the next frame that uses
// them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "gpu/memory.h"
#include "graph/frame_graph.h"
#include "passes/gpu_scene/texture_buckets.h"

namespace lightwell {

struct StaticBuffer {
  std::unique_ptr<Buffer> buffer;
  std::vector<std::byte> pending;  // empty: the GPU has them
};

struct StaticImage {
  std::unique_ptr<ImageResource> image;
  std::vector<std::byte> pending;
};

template <class T>
std::vector<std::byte> to_bytes(const std::vector<T>& elements) {
  const auto bytes = std::as_bytes(std::span(elements));
  return {bytes.begin(), bytes.end()};
}

// Throws InputError if the device cannot address `bytes` in one storage buffer.
void check_buffer_size(const Device& device, std::string_view name, std::uint64_t bytes);

// These throw InputError if `bytes` or the textures are too many for the device.
StaticBuffer make_buffer(Device& device, std::string_view name, std::vector<std::byte> bytes);
StaticImage make_textures(Device& device, std::size_t bucket, TextureBucket&& textures);

// The graph's handle; after the copy of what is pending.
BufferHandle import(FrameGraph& graph, StaticBuffer& from);
ImageHandle import(FrameGraph& graph, StaticImage& from);

}  // namespace lightwell
