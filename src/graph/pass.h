// The kinds of passes, one type each: plain data that plan and executor read, filled by calls that check their
// arguments against the shader's reflection at once. FrameGraph makes them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "gpu/kernel_code.h"
#include "gpu/raster_state.h"
#include "gpu/reflection.h"
#include "gpu/vulkan.h"
#include "graph/handles.h"

namespace lightwell {

class FrameGraph;

enum class UseKind : std::uint8_t {
  kUniformRead,      // uniform buffer
  kStorageRead,      // storage buffer or image that the shader cannot write
  kStorageWrite,     // storage buffer or image, read and written
  kSampled,          // sampled image
  kColorAttachment,  // read and written
  kDepthAttachment,
  kTransferRead,
  kTransferWrite,
  kIndirectRead,
  kIndexRead,
  kAccelerationStructureRead,   // by ray queries, or by the build of a top level
  kAccelerationStructureBuild,  // the target or the scratch memory of a build
  kBuildInput,                  // corners or instances
};

bool is_write(UseKind kind);

struct ResourceUse {
  bool is_image = false;
  std::uint32_t index = 0;
  UseKind kind = UseKind::kStorageRead;
  VkPipelineStageFlags2 stages = 0;
  Subresource part{};     // of an image
  bool discards = false;  // a write that leaves nothing of what was there
};

struct BoundResource {
  ResourceUse use;
  ShaderBinding binding;
  SamplerKind sampler = SamplerKind::kNearestClamp;
};

struct PushData {
  std::array<std::byte, 128> bytes{};
  std::uint32_t size = 0;
};

// What every pass has.
struct PassBase {
  std::string name;
  FrameGraph* graph = nullptr;
  std::size_t number = 0;                        // in the frame
  std::vector<ResourceUse> uses;                 // all of them, bound ones included
  std::vector<std::function<void()>> callbacks;  // run once the frame has been recorded with this pass in it

  void add_use(const ResourceUse& use) { uses.push_back(use); }
};

// What passes with shaders have.
struct ShaderPassBase : PassBase {
  std::vector<const Reflection*> stages;  // compute, or vertex + fragment
  std::vector<const KernelCode*> codes;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> constants;  // id, value
  std::vector<BoundResource> bound;                                // in set 0
  std::vector<SetHandle> sets;
  PushData push_data;

 protected:
  void bind_buffer(std::string_view binding, BufferHandle buffer);
  void bind_image(std::string_view binding, ImageHandle image, SamplerKind sampler, Subresource part);
  void bind_structure(std::string_view binding, AccelerationStructureHandle structure);
  void bind_written(std::string_view binding, BufferHandle& buffer);
  void bind_written(std::string_view binding, ImageHandle& image, Subresource part);
  void bind_set(SetHandle set);
  void set_constant(std::string_view name, std::uint32_t value);
  bool try_constant(std::string_view name, std::uint32_t value);
  void push_bytes(std::span<const std::byte> bytes, std::span<const ParamMember> members);

 private:
  const ShaderBinding& find_binding(std::string_view binding, bool writes);
  void set_page_count(const ShaderBinding& binding, BufferHandle buffer);
};

// The calls that passes with shaders share, each giving back the pass itself.
template <class Self>
class ShaderPass : public ShaderPassBase {
 public:
  // Names are the shader's own, in set 0. A buffer whose binding is an array of blocks is bound in pages.
  Self& read(std::string_view binding, BufferHandle buffer) {
    bind_buffer(binding, buffer);
    return self();
  }
  Self& read(std::string_view binding, ImageHandle image, SamplerKind sampler = SamplerKind::kNearestClamp,
             Subresource part = kWholeImage) {
    bind_image(binding, image, sampler, part);
    return self();
  }
  Self& read(std::string_view binding, AccelerationStructureHandle structure) {
    bind_structure(binding, structure);
    return self();
  }
  // Gives the handle a new version.
  Self& write(std::string_view binding, BufferHandle& buffer) {
    bind_written(binding, buffer);
    return self();
  }
  Self& write(std::string_view binding, ImageHandle& image, Subresource part = kWholeImage) {
    bind_written(binding, image, part);
    return self();
  }
  // Binds a whole set of resources (FrameGraph::create_set), with its constants where the shader has them.
  Self& bind(SetHandle set) {
    bind_set(set);
    return self();
  }
  // Specialisation constant by its name in the shader.
  Self& constant(std::string_view name, std::uint32_t value) {
    set_constant(name, value);
    return self();
  }
  template <class Params>
  Self& push(const Params& params) {
    push_bytes(std::as_bytes(std::span(&params, 1)), Params::members());
    return self();
  }
  // Runs `done` once the frame has been recorded with this pass in it: neither culled nor refused.
  Self& on_recorded(std::function<void()> done) {
    callbacks.push_back(std::move(done));
    return self();
  }

 private:
  Self& self() { return static_cast<Self&>(*this); }
};

class ComputePass : public ShaderPass<ComputePass> {
 public:
  // Exactly one of these. dispatch_threads divides by the kernel's own workgroup size, rounding up.
  void dispatch(std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
  void dispatch_threads(std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
  // `arguments`: VkDispatchIndirectCommand at `offset` bytes.
  void dispatch_indirect(BufferHandle arguments, std::uint64_t offset = 0);

  std::array<std::uint32_t, 3> groups{0, 0, 0};
  std::optional<std::pair<BufferHandle, std::uint64_t>> indirect;
};

struct DrawCall {
  std::uint32_t count = 0;  // vertices, or indices where the pass has an index buffer
  std::uint32_t instances = 1;
  std::uint32_t first = 0;  // vertex or index
  std::uint32_t first_instance = 0;
  std::optional<VkRect2D> viewport;                                // default: the whole render area
  std::optional<std::pair<BufferHandle, std::uint64_t>> indirect;  // instead of the numbers above
  PushData push;
};

struct Attachment {
  ImageHandle image;
  Subresource part;
  std::optional<VkClearValue> clear;
};

class RasterPass : public ShaderPass<RasterPass> {
 public:
  // Attachments in order of location; `clear` empty keeps what is there. Of images with mips or layers: mip 0, layer 0
  // where `part` says nothing.
  RasterPass& color(ImageHandle& image, std::optional<VkClearColorValue> clear, Subresource part = kWholeImage);
  RasterPass& depth(ImageHandle& image, std::optional<float> clear, Subresource part = kWholeImage);
  RasterPass& render_area(std::uint32_t width, std::uint32_t height);  // for passes without attachments
  RasterPass& index_buffer(BufferHandle indices);                      // 32-bit

  RasterPass& draw(std::uint32_t count, std::uint32_t instances = 1) {
    return draw(DrawCall{.count = count, .instances = instances});
  }
  // With what was pushed last.
  RasterPass& draw(DrawCall call);
  // VkDrawIndirectCommand, or VkDrawIndexedIndirectCommand where the pass has an index buffer, at `offset` bytes.
  RasterPass& draw_indirect(BufferHandle arguments, std::uint64_t offset = 0);
  template <class Params>
  RasterPass& draw_in(VkRect2D viewport, const Params& params, std::uint32_t count, std::uint32_t first = 0) {
    push(params);
    return draw(DrawCall{.count = count, .first = first, .viewport = viewport});
  }

  RasterState raster;
  std::vector<Attachment> colors;
  std::optional<Attachment> depth_attachment;
  std::array<std::uint32_t, 2> area{0, 0};
  BufferHandle indices;
  std::vector<DrawCall> draws;

 private:
  Attachment attach(ImageHandle& image, UseKind kind, Subresource part, bool clears);
};

struct BufferCopyPass : PassBase {
  BufferHandle source;
  BufferHandle target;
  std::uint64_t size = 0;
  std::uint64_t source_offset = 0;
  std::uint64_t target_offset = 0;
};

// Between an image and a tightly packed buffer.
struct ImageCopyPass : PassBase {
  BufferHandle buffer;
  ImageHandle image;
  bool to_image = false;       // all mips and layers, mip by mip
  std::uint32_t from_mip = 0;  // otherwise: all layers of this one
};

struct FillPass : PassBase {
  BufferHandle target;
  std::uint32_t value = 0;
};

// Of an acceleration structure.
struct BuildPass : PassBase {
  AccelerationStructureHandle target;
  BufferHandle input;
  BufferHandle scratch;
  bool update = false;  // starts from the last build's tree
};

using Pass = std::variant<ComputePass, RasterPass, BufferCopyPass, ImageCopyPass, FillPass, BuildPass>;

inline PassBase& base_of(Pass& pass) {
  return std::visit([](auto& p) -> PassBase& { return p; }, pass);
}
inline const PassBase& base_of(const Pass& pass) {
  return std::visit([](const auto& p) -> const PassBase& { return p; }, pass);
}
// Null for passes without shaders.
const ShaderPassBase* shader_pass(const Pass& pass);

}  // namespace lightwell
