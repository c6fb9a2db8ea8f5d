// Buffers and images of the GPU that the host fills once: their bytes wait in host memory for the first frame that is
// recorded with them.
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
  std::unique_ptr<Buffer> staging;  // none: the GPU has the bytes
};

struct StaticImage {
  std::unique_ptr<ImageResource> image;
  std::unique_ptr<Buffer> staging;  // texels, mip by mip, each with all its layers
};

template <class T>
std::span<const std::byte> as_byte_span(const std::vector<T>& elements) {
  return std::as_bytes(std::span(elements));
}

// Throws InputError if the device cannot address `bytes` in one storage buffer.
void check_buffer_size(const Device& device, std::string_view name, std::uint64_t bytes);

// These throw InputError if `bytes` or the textures are too many for the device.
StaticBuffer make_buffer(Device& device, std::string_view name, std::span<const std::byte> bytes);
StaticImage make_textures(Device& device, std::size_t bucket, const TextureBucket& textures);

// Host memory for the caller to write an image's texels to, which are `bytes` in all.
StaticImage make_image(Device& device, std::string_view name, const ImageInfo& info, std::uint64_t bytes);

// Copies bytes of this frame's to the start of a buffer.
void upload(FrameGraph& graph, BufferHandle& target, std::span<const std::byte> bytes);

// The graph's handle; after the copy of what is staged. What the graph records must outlive its recording.
BufferHandle import(FrameGraph& graph, StaticBuffer& from);
ImageHandle import(FrameGraph& graph, StaticImage& from);

}  // namespace lightwell
