// The frame graph: a frame is a list of passes that declare what they read and write; barriers, pooled memory, debug
// labels, GPU timers, and which passes run at all follow from that.
//
//   ImageHandle blurred = graph.create_image("blurred", {.width = w, .height = h, .format =
//   VK_FORMAT_R16G16B16A16_SFLOAT}); graph.compute("blur", kernels::filter_blur_comp)
//       .read("source", noisy)            // names are the shader's own
//       .write("target", blurred)
//       .push(glsl::BlurParams{...})
//       .dispatch_threads(w, h);
//
// Passes that lead to no root are culled. Roots are read-backs, writes to imported resources and to plain histories,
// and the current side of history pairs whose `previous` some pass reads: the next frame will want it.
//
// Nothing here calls Vulkan: declaration and planning (graph/plan.h) are tested without a device; GraphExecutor
// (graph/executor.h) records the plan into a command buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "graph/history.h"
#include "graph/pass.h"

namespace lightwell {

class AccelerationStructure;
class Buffer;
class ImageResource;

enum class Lifetime : std::uint8_t { kTransient, kHistory, kImported, kUpload, kReadback };

// A history that a resource stands for.
struct HistoryKey {
  std::string name;           // scope included; empty: none
  bool is_pair = false;       // one of two that take turns
  std::uint32_t side = 0;     // of a pair
  std::uint32_t partner = 0;  // index of the other resource of the pair
  bool is_current = false;    // of a pair: the one that this frame writes
};

struct BufferResource {
  std::string name;
  BufferDesc desc;
  Lifetime lifetime = Lifetime::kTransient;
  std::uint32_t version = 0;
  std::size_t last_writer = 0;  // number of the pass
  Buffer* imported = nullptr;
  AccelerationStructure* structure = nullptr;  // that this is the memory of
  std::vector<std::byte> data;                 // of an upload
  HistoryKey history;
};

struct ImageNode {
  std::string name;
  ImageDesc desc;
  Lifetime lifetime = Lifetime::kTransient;
  std::uint32_t version = 0;
  std::size_t last_writer = 0;  // number of the pass
  ImageResource* imported = nullptr;
  std::optional<VkImageLayout> final_layout;  // for images that a host lent
  HistoryKey history;
};

// Resources that many kernels bind alike, as one descriptor set beside their own set 0.
struct SetMember {
  std::string binding;  // its name in the shaders
  BufferHandle buffer;  // one of these three
  ImageHandle image;
  AccelerationStructureHandle structure;
  SamplerKind sampler = SamplerKind::kNearestClamp;
};

struct ResourceSet {
  std::string name;
  std::uint32_t number = 1;  // of the set in the shaders
  std::vector<SetMember> members;
  std::vector<std::pair<std::string, std::uint32_t>> constants;  // for shaders that have them
};

// A readback that was asked for; give it to GraphExecutor::fetch() when the frame has completed.
struct ReadbackTicket {
  std::uint32_t buffer = UINT32_MAX;  // index in this graph
  std::uint64_t size = 0;
};

class FrameGraph {
 public:
  explicit FrameGraph(GraphContext& context) : context_(context) {}
  // A frame that was declared and never recorded: what passes keep beside their histories may be ahead of them, so all
  // histories are fresh in the next one.
  ~FrameGraph();
  FrameGraph(const FrameGraph&) = delete;
  FrameGraph& operator=(const FrameGraph&) = delete;

  // Undefined content until written; memory is shared with other transients whose lives do not overlap.
  BufferHandle create_buffer(std::string_view name, std::uint64_t count, std::uint32_t stride);
  ImageHandle create_image(std::string_view name, const ImageDesc& desc);

  // Whose histories are asked for until the scope ends, when it was before's again: the same names in two scopes are
  // two histories. `cut`: what was before says nothing about this frame, so no pair is valid.
  class Scope {
   public:
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    friend class FrameGraph;
    Scope(FrameGraph& graph, std::string_view name, bool cut);
    FrameGraph& graph_;
    std::string outer_;
    bool outer_cut_;
  };
  [[nodiscard]] Scope enter(std::string_view name, bool cut);

  // Survives from frame to frame under its name. `fresh` says that the content is undefined (first frame, or the
  // description changed): the caller must then initialise it.
  BufferHandle history_buffer(std::string_view name, std::uint64_t count, std::uint32_t stride, bool& fresh);
  ImageHandle history_image(std::string_view name, const ImageDesc& desc, bool& fresh);
  // Two that take turns: the one that last frame wrote, and the one to write now.
  BufferPair history_pair(std::string_view name, std::uint64_t count, std::uint32_t stride);
  ImagePair history_pair(std::string_view name, const ImageDesc& desc);

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

  SetHandle create_set(ResourceSet set);

  ComputePass& compute(std::string_view name, const KernelCode& code);
  RasterPass& raster(std::string_view name, const KernelCode& vertex, const KernelCode& fragment,
                     const RasterState& state);

  void fill(std::string_view name, BufferHandle& buffer, std::uint32_t value);
  BufferCopyPass& copy(std::string_view name, BufferHandle source, BufferHandle& target, std::uint64_t size,
                       std::uint64_t source_offset = 0, std::uint64_t target_offset = 0);
  // Builds a bottom level from its corners (kTriangleBytes a triangle). `update`: from the tree of the last build.
  void build(std::string_view name, AccelerationStructureHandle& target, BufferHandle corners, bool update);
  // Builds a top level of whole bottom levels, where they stand. Ray queries get their number as the custom index.
  void build(std::string_view name, AccelerationStructureHandle& target,
             std::span<const AccelerationStructureHandle> bottom_levels);
  // All mips and layers, tightly packed, mip by mip, each with all its layers.
  void copy(std::string_view name, BufferHandle source, ImageHandle& target);
  ReadbackTicket read_back(BufferHandle source);
  ReadbackTicket read_back(ImageHandle source, std::uint32_t mip = 0);  // all layers, tightly packed
  // Gives the buffer's content to `done` when the executor knows the frame to be complete: in a later record() or
  // notice_completed(). Nothing waits for it; never where the frame is dropped. `done` holds what it needs.
  using Watcher = std::function<void(std::span<const std::byte>)>;
  void watch(BufferHandle source, Watcher done);

  // Runs `done` once the frame has been recorded; never where it is dropped before. State that says what the GPU holds
  // after this frame changes there, not at declaration.
  void on_recorded(std::function<void()> done) { callbacks_.push_back(std::move(done)); }

  const BufferDesc& desc(BufferHandle handle) const;
  const ImageDesc& desc(ImageHandle handle) const;
  const std::string& name(BufferHandle handle) const;
  const std::string& name(ImageHandle handle) const;
  std::uint64_t descriptor_range() const { return context_.descriptor_range; }

  // ---- the declaration ----
  const std::deque<Pass>& passes() const { return passes_; }
  const std::vector<BufferResource>& buffers() const { return buffers_; }
  const std::vector<ImageNode>& images() const { return images_; }
  const std::vector<ResourceSet>& sets() const { return sets_; }
  // The executor's word that the frame is recorded: histories and callbacks take notice. `is_alive`: one a pass.
  void note_recorded(const std::vector<bool>& is_alive);
  std::vector<std::pair<ReadbackTicket, Watcher>> take_watchers() { return std::move(watchers_); }

 private:
  friend struct PassBase;
  friend struct ShaderPassBase;
  friend class ComputePass;
  friend class RasterPass;
  void check_current(BufferHandle handle, std::string_view pass) const;
  void check_current(ImageHandle handle, std::string_view pass) const;
  void check_current(AccelerationStructureHandle handle, std::string_view pass) const;
  // Handles that a pass uses must be current, and written by no later pass than it.
  template <class Handle>
  void check_use(Handle handle, const PassBase& pass) const;
  void renew(BufferHandle& handle, const PassBase& pass);
  void renew(ImageHandle& handle, const PassBase& pass);
  BufferHandle add_buffer(BufferResource resource);
  ImageHandle add_image(ImageNode node);
  template <class Kind>
  Kind& add_pass(std::string_view name);
  BuildPass& add_build(std::string_view name, AccelerationStructureHandle& target, BufferHandle input);
  std::string scoped(std::string_view name) const { return scope_ + std::string(name); }

  GraphContext& context_;
  std::deque<Pass> passes_;  // references to passes stay valid
  std::vector<BufferResource> buffers_;
  std::vector<ImageNode> images_;
  std::vector<ResourceSet> sets_;
  std::vector<std::function<void()>> callbacks_;
  std::vector<std::pair<ReadbackTicket, Watcher>> watchers_;
  std::string scope_;
  bool cut_ = false;
  bool recorded_ = false;
};

}  // namespace lightwell
