// The frame graph: a frame is a list of passes that declare what they read and write; barriers, pooled memory, debug
// labels and GPU timers follow from that.
//
//   ImageHandle blurred = graph.create_image("blurred", {.width = w, .height = h, .format =
//   VK_FORMAT_R16G16B16A16_SFLOAT}); graph.compute("blur", kernels::filter_blur_comp)
//       .read("source", noisy)            // names are the shader's own
//       .write("target", blurred)
//       .push(glsl::BlurParams{...})
//       .dispatch_threads(w, h);
//
// A write gives the handle a new version: copies of the old one are stale, and using one stops the program by name.
// Nothing here calls Vulkan: declaration and planning (graph/plan.h) are tested without a device; GraphExecutor
// (graph/executor.h) records the plan into a command buffer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/kernel_code.h"
#include "gpu/raster_state.h"
#include "gpu/reflection.h"
#include "gpu/vulkan.h"

namespace lightwell {

class AccelerationStructure;
class Buffer;
class ImageResource;

struct BufferHandle {
  std::uint32_t index = UINT32_MAX;
  std::uint32_t version = 0;
  explicit operator bool() const { return index != UINT32_MAX; }
};

struct ImageHandle {
  std::uint32_t index = UINT32_MAX;
  std::uint32_t version = 0;
  explicit operator bool() const { return index != UINT32_MAX; }
};

// Of an AccelerationStructure that somebody owns (import_acceleration_structure); it lies among the buffers.
struct AccelerationStructureHandle {
  std::uint32_t index = UINT32_MAX;
  std::uint32_t version = 0;
  explicit operator bool() const { return index != UINT32_MAX; }
};

struct BufferDesc {
  std::uint64_t size = 0;    // bytes
  std::uint32_t stride = 0;  // of an element; 0: not checked against the shader
  bool operator==(const BufferDesc&) const = default;
};

struct ImageDesc {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  std::uint32_t depth = 1;  // > 1: a 3D image
  std::uint32_t layers = 1;
  std::uint32_t mips = 1;
  VkFormat format = VK_FORMAT_UNDEFINED;
  bool array = false;  // seen as an array in shaders even with one layer
  bool operator==(const ImageDesc&) const = default;
};

enum class SamplerKind : std::uint8_t { kNearestClamp, kLinearClamp, kLinearRepeat, kNearestRepeat, kShadow };

// ---- what is kept of a declaration: plain data, read by plan and executor ----

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

struct ResourceUse {
  bool is_image = false;
  std::uint32_t index = 0;
  UseKind kind = UseKind::kStorageRead;
  VkPipelineStageFlags2 stages = 0;
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

struct DrawCall {
  std::uint32_t count = 0;  // vertices, or indices where the pass has an index buffer
  std::uint32_t instances = 1;
  std::optional<VkRect2D> viewport;  // default: the whole render area
  PushData push;
};

struct Attachment {
  ImageHandle image;
  std::optional<VkClearValue> clear;
};

// Declares one pass. Every method checks its arguments against the shader's reflection at once.
class Pass {
 public:
  enum class Kind : std::uint8_t {
    kCompute,
    kRaster,
    kCopyBuffer,
    kCopyImageToBuffer,
    kCopyBufferToImage,
    kFillBuffer,
    kBuild  // of an acceleration structure
  };

  Pass& read(std::string_view binding, BufferHandle buffer);
  Pass& read(std::string_view binding, ImageHandle image, SamplerKind sampler = SamplerKind::kNearestClamp);
  Pass& read(std::string_view binding, AccelerationStructureHandle structure);
  // Gives the handle a new version.
  Pass& write(std::string_view binding, BufferHandle& buffer);
  Pass& write(std::string_view binding, ImageHandle& image);

  // Specialisation constant by its name in the shader.
  Pass& constant(std::string_view name, std::uint32_t value);

  template <class Params>
  Pass& push(const Params& params) {
    return push_bytes(std::as_bytes(std::span(&params, 1)), Params::members());
  }

  // Compute: exactly one of these. dispatch_threads divides by the kernel's own workgroup size, rounding up.
  void dispatch(std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
  void dispatch_threads(std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
  void dispatch_indirect(BufferHandle arguments, std::uint64_t offset = 0);

  // Raster: attachments in order of location; `clear` empty keeps what is there.
  Pass& color(ImageHandle& image, std::optional<VkClearColorValue> clear);
  Pass& depth(ImageHandle& image, std::optional<float> clear);
  Pass& render_area(std::uint32_t width, std::uint32_t height);  // for passes without attachments
  Pass& index_buffer(BufferHandle indices);                      // 32-bit
  Pass& draw(std::uint32_t count, std::uint32_t instances = 1);
  template <class Params>
  Pass& draw_in(VkRect2D viewport, const Params& params, std::uint32_t count) {
    push(params);
    draws.push_back({count, 1, viewport, push_data});
    return *this;
  }

  // ---- the declaration ----
  Kind kind = Kind::kCompute;
  std::string name;
  class FrameGraph* graph = nullptr;
  std::vector<const Reflection*> stages;  // compute, or vertex + fragment
  std::vector<const KernelCode*> codes;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> constants;  // id, value
  std::vector<BoundResource> bound;
  std::vector<ResourceUse> uses;  // all of them, bound ones included
  PushData push_data;
  std::array<std::uint32_t, 3> groups{0, 0, 0};
  std::optional<std::pair<BufferHandle, std::uint64_t>> indirect;
  RasterState raster;
  std::vector<Attachment> colors;
  std::optional<Attachment> depth_attachment;
  std::array<std::uint32_t, 2> area{0, 0};
  BufferHandle indices;
  std::vector<DrawCall> draws;
  std::uint64_t copy_size = 0;
  std::uint64_t source_offset = 0;
  std::uint64_t target_offset = 0;
  std::uint32_t fill_value = 0;
  bool update = false;  // of a build: starts from the last one's tree

 private:
  friend class FrameGraph;
  const ShaderBinding& find_binding(std::string_view binding, bool writes);
  void add_use(bool is_image, std::uint32_t index, UseKind kind, VkPipelineStageFlags2 stages_mask);
  Pass& push_bytes(std::span<const std::byte> bytes, std::span<const ParamMember> members);
};

enum class Lifetime : std::uint8_t { kTransient, kHistory, kImported, kUpload, kReadback };

struct BufferResource {
  std::string name;
  BufferDesc desc;
  Lifetime lifetime = Lifetime::kTransient;
  std::uint32_t version = 0;
  Buffer* imported = nullptr;
  AccelerationStructure* structure = nullptr;  // that this is the memory of
  std::vector<std::byte> data;                 // of an upload
};

struct ImageNode {
  std::string name;
  ImageDesc desc;
  Lifetime lifetime = Lifetime::kTransient;
  std::uint32_t version = 0;
  ImageResource* imported = nullptr;
  std::optional<VkImageLayout> final_layout;  // for images that a host lent
};

// What outlives a frame on the declaring side: which histories exist, and shader reflections. Owned by the executor,
// or by a test.
class GraphContext {
 public:
  const Reflection& reflection(const KernelCode& code);

  std::map<std::string, BufferDesc> history_buffers;
  std::map<std::string, ImageDesc> history_images;

 private:
  std::map<const std::uint32_t*, Reflection> reflections_;
};

// A readback that was asked for; give it to GraphExecutor::fetch() when the frame has completed.
struct ReadbackTicket {
  std::uint32_t buffer = UINT32_MAX;  // index in this graph
  std::uint64_t size = 0;
};

class FrameGraph {
 public:
  explicit FrameGraph(GraphContext& context) : context_(context) {}
  FrameGraph(const FrameGraph&) = delete;
  FrameGraph& operator=(const FrameGraph&) = delete;

  // Undefined content until written; memory is shared with other transients whose lives do not overlap.
  BufferHandle create_buffer(std::string_view name, std::uint64_t count, std::uint32_t stride);
  ImageHandle create_image(std::string_view name, const ImageDesc& desc);

  // Survives from frame to frame under its name. `fresh` says that the content is undefined (first frame, or the
  // description changed): the caller must then initialise it.
  BufferHandle history_buffer(std::string_view name, std::uint64_t count, std::uint32_t stride, bool& fresh);
  ImageHandle history_image(std::string_view name, const ImageDesc& desc, bool& fresh);

  // Owned by somebody who outlives the frame's execution. `stride` of an element; 0: not checked against the shader.
  BufferHandle import_buffer(Buffer& buffer, std::uint32_t stride = 0);
  // `final_layout`: the layout in which a host wants its image back.
  ImageHandle import_image(ImageResource& image, std::optional<VkImageLayout> final_layout = {});
  AccelerationStructureHandle import_acceleration_structure(AccelerationStructure& structure);

  // Bytes that the shader reads this frame (host memory of the frame's slot).
  BufferHandle upload_bytes(std::string_view name, std::span<const std::byte> bytes, std::uint32_t stride);
  template <class T>
  BufferHandle upload(std::string_view name, std::span<const T> elements) {
    return upload_bytes(name, std::as_bytes(elements), sizeof(T));
  }

  Pass& compute(std::string_view name, const KernelCode& code);
  Pass& raster(std::string_view name, const KernelCode& vertex, const KernelCode& fragment, const RasterState& state);

  void fill(std::string_view name, BufferHandle& buffer, std::uint32_t value);
  void copy(std::string_view name, BufferHandle source, BufferHandle& target, std::uint64_t size,
            std::uint64_t source_offset = 0, std::uint64_t target_offset = 0);
  // Builds a bottom level from its corners (kTriangleBytes a triangle). `update`: from the tree of the last build.
  void build(std::string_view name, AccelerationStructureHandle& target, BufferHandle corners, bool update);
  // Builds a top level of whole bottom levels, where they stand. Ray queries get their number as the custom index.
  void build(std::string_view name, AccelerationStructureHandle& target,
             std::span<const AccelerationStructureHandle> bottom_levels);
  // All mips and layers, tightly packed, mip by mip, each with all its layers.
  void copy(std::string_view name, BufferHandle source, ImageHandle& target);
  ReadbackTicket read_back(BufferHandle source);
  ReadbackTicket read_back(ImageHandle source);  // mip 0, all layers, tightly packed

  // Runs `done` when the frame has been recorded. A declared frame may be refused: state that says what the GPU holds
  // after this frame changes here, not at declaration.
  void on_recorded(std::function<void()> done) { on_recorded_.push_back(std::move(done)); }
  void notify_recorded();  // by the executor

  const BufferDesc& desc(BufferHandle handle) const;
  const ImageDesc& desc(ImageHandle handle) const;
  const std::string& name(BufferHandle handle) const;

  // ---- the declaration ----
  const std::deque<Pass>& passes() const { return passes_; }
  const std::vector<BufferResource>& buffers() const { return buffers_; }
  const std::vector<ImageNode>& images() const { return images_; }

 private:
  friend class Pass;
  void check_current(BufferHandle handle, std::string_view pass) const;
  void check_current(ImageHandle handle, std::string_view pass) const;
  void check_current(AccelerationStructureHandle handle, std::string_view pass) const;
  BufferHandle add_buffer(BufferResource resource);
  ImageHandle add_image(ImageNode node);
  Pass& add_pass(std::string_view name, Pass::Kind kind);
  Pass& add_build(std::string_view name, AccelerationStructureHandle& target, BufferHandle input);

  GraphContext& context_;
  std::deque<Pass> passes_;  // references to passes stay valid
  std::vector<BufferResource> buffers_;
  std::vector<ImageNode> images_;
  std::vector<std::function<void()>> on_recorded_;
};

// Bytes of one texel; asserts on formats that the graph does not know.
std::uint32_t texel_size(VkFormat format);
bool is_depth_format(VkFormat format);

}  // namespace lightwell
