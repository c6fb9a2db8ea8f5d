#include "passes/gpu_scene/gpu_scene.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "gpu/device.h"
#include "kernels/passes/gpu_scene/world_vertices.comp.h"
#include "lightwell/error.h"
#include "passes/gpu_scene/flatten.h"
#include "passes/gpu_scene/texture_buckets.h"

namespace lightwell {
namespace {

template <class T>
std::vector<std::byte> to_bytes(const std::vector<T>& elements) {
  const auto bytes = std::as_bytes(std::span(elements));
  return {bytes.begin(), bytes.end()};
}

// A buffer or image of the GPU and the bytes that the first frame copies into it.
struct StaticBuffer {
  std::unique_ptr<Buffer> buffer;
  std::vector<std::byte> pending;
};

struct StaticImage {
  std::unique_ptr<ImageResource> image;
  std::vector<std::byte> pending;
};

StaticBuffer make_buffer(Device& device, std::string_view name, std::vector<std::byte> bytes) {
  if (bytes.size() > device.limits().maxStorageBufferRange) {
    throw InputError("scene", std::string(name) + " need " + std::to_string(bytes.size() >> 20) +
                                  " MiB, more than this device can address (" +
                                  std::to_string(device.limits().maxStorageBufferRange >> 20) + " MiB)");
  }
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

}  // namespace

struct GpuScene::State {
  PrimitiveMaterials primitive_materials;
  std::vector<glsl::Part> parts;  // of the last frame
  StaticBuffer object_vertices;
  StaticBuffer sources;
  StaticBuffer indices;
  StaticBuffer materials;
  std::array<StaticImage, 4> textures;
  Frame constants;  // what does not change from frame to frame
  std::uint64_t revision = 0;

  BufferHandle import(FrameGraph& graph, StaticBuffer& from) const;
  ImageHandle import(FrameGraph& graph, StaticImage& from) const;
};

// The graph's handle; the first time, after the copy of its content.
BufferHandle GpuScene::State::import(FrameGraph& graph, StaticBuffer& from) const {
  BufferHandle handle = graph.import_buffer(*from.buffer);
  if (!from.pending.empty()) {
    const BufferHandle source = graph.upload_bytes(from.buffer->name() + " upload", from.pending, 0);
    graph.copy("upload " + from.buffer->name(), source, handle, from.pending.size());
    from.pending = {};
  }
  return handle;
}

ImageHandle GpuScene::State::import(FrameGraph& graph, StaticImage& from) const {
  ImageHandle handle = graph.import_image(*from.image);
  if (!from.pending.empty()) {
    const BufferHandle source = graph.upload_bytes(from.image->name() + " upload", from.pending, 0);
    graph.copy("upload " + from.image->name(), source, handle);
    from.pending = {};
  }
  return handle;
}

GpuScene::GpuScene(Device& device, const Scene& scene, const SceneSnapshot& snapshot)
    : state_(std::make_unique<State>()) {
  FlatGeometry geometry = flatten_geometry(scene, snapshot.instances);
  if (geometry.sources.size() * sizeof(glsl::WorldVertex) > device.limits().maxStorageBufferRange) {
    throw InputError("scene", std::to_string(geometry.sources.size()) + " vertices; a buffer of this device holds " +
                                  std::to_string(device.limits().maxStorageBufferRange / sizeof(glsl::WorldVertex)));
  }
  TextureBuckets textures = build_texture_buckets(scene);
  const std::vector<glsl::GpuMaterial> materials = flatten_materials(scene, textures.slots);

  state_->primitive_materials = list_primitive_materials(scene);
  state_->constants.vertex_count = static_cast<std::uint32_t>(geometry.sources.size());
  state_->constants.triangle_count = static_cast<std::uint32_t>(geometry.indices.size() / 3);
  state_->constants.opaque_triangle_count = geometry.opaque_triangle_count;
  constexpr std::uint32_t kNoTexture = 0xffffffffu;
  for (const glsl::GpuMaterial& material : materials) {
    std::uint32_t& arrays = state_->constants.texture_arrays;
    if (material.base_texture != kNoTexture) arrays |= 1u << (material.base_texture >> 16);
    if (material.emission_texture != kNoTexture) arrays |= 16u << (material.emission_texture >> 16);
    for (int c = 0; c < 3; ++c) {
      state_->constants.emission_maximum = std::max(state_->constants.emission_maximum, material.emission[c]);
    }
  }
  state_->object_vertices = make_buffer(device, "object vertices", to_bytes(geometry.object_vertices));
  state_->sources = make_buffer(device, "vertex sources", to_bytes(geometry.sources));
  state_->indices = make_buffer(device, "indices", to_bytes(geometry.indices));
  state_->materials = make_buffer(device, "materials", to_bytes(materials));
  for (std::size_t i = 0; i < textures.buckets.size(); ++i) {
    state_->textures[i] = make_textures(device, i, std::move(textures.buckets[i]));
  }
}

GpuScene::~GpuScene() = default;

GpuScene::Frame GpuScene::record(FrameGraph& graph, const SceneSnapshot& snapshot) {
  State& state = *state_;
  std::vector<glsl::Part> parts = make_parts(state.primitive_materials, snapshot.instances);
  LW_ASSERT(state.parts.empty() || parts.size() == state.parts.size(),
            "snapshot has " + std::to_string(parts.size()) + " parts, the scene " + std::to_string(state.parts.size()));
  const bool moved = state.revision == 0 || (!parts.empty() && std::memcmp(parts.data(), state.parts.data(),
                                                                           parts.size() * sizeof(glsl::Part)) != 0);
  if (moved) ++state.revision;
  state.parts = std::move(parts);

  Frame frame = state.constants;
  frame.revision = state.revision;
  frame.static_revision = state.revision;
  frame.indices = state.import(graph, state.indices);
  frame.materials = state.import(graph, state.materials);
  for (std::size_t i = 0; i < state.textures.size(); ++i) frame.textures[i] = state.import(graph, state.textures[i]);

  bool fresh = false;
  frame.vertices = graph.history_buffer("world vertices", frame.vertex_count, sizeof(glsl::WorldVertex), fresh);
  frame.previous_positions = graph.create_buffer("previous positions", frame.vertex_count, sizeof(glm::vec4));
  const BufferHandle sources = state.import(graph, state.sources);
  const BufferHandle object_vertices = state.import(graph, state.object_vertices);
  Pass& pass = graph.compute("world vertices", kernels::gpu_scene_world_vertices_comp);
  pass.read("sources", sources)
      .read("object_vertices", object_vertices)
      .read("parts", graph.upload<glsl::Part>("parts", state.parts))
      .write("vertices", frame.vertices)
      .write("previous_positions", frame.previous_positions)
      .push(glsl::WorldVerticesParams{frame.vertex_count, fresh ? 1u : 0u});
  const std::uint32_t groups = std::max(1u, (frame.vertex_count + 63) / 64);
  const std::uint32_t columns = std::min(groups, 32768u);
  pass.dispatch(columns, (groups + columns - 1) / columns);
  return frame;
}

}  // namespace lightwell
