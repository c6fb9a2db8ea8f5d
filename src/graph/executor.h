// Records planned frames into command buffers that the caller owns, submits and waits for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gpu/deferred_destruction.h"
#include "gpu/device.h"
#include "graph/frame_graph.h"
#include "graph/plan.h"

namespace lightwell {

struct Pipeline;

struct PassTime {
  std::string name;
  double time_ms = 0;       // GPU time of all passes of this name in the frame
  std::uint32_t count = 0;  // how many there were
};

// One executor serves one sequence of frames on one queue. Up to `frames_in_flight` frames may be recorded before the
// oldest has completed. When it goes, all frames that it recorded have completed or will never be submitted.
class GraphExecutor {
 public:
  explicit GraphExecutor(Device& device, std::uint32_t frames_in_flight = 2);
  ~GraphExecutor();
  GraphExecutor(const GraphExecutor&) = delete;
  GraphExecutor& operator=(const GraphExecutor&) = delete;

  GraphContext& context() { return context_; }
  Device& device() { return device_; }

  // Records the frame, never submits or waits. `completed` is the number of the last frame that the GPU has finished
  // (0: none yet). Returns this frame's number: 1, 2, ... Where it throws, nothing that outlives the frame has noticed
  // it.
  std::uint64_t record(FrameGraph& graph, VkCommandBuffer commands, std::uint64_t completed);

  // Tells those who watch buffers (FrameGraph::watch) of frames up to `completed`; record() does so too.
  void notice_completed(std::uint64_t completed);

  // Of a completed frame among the last `frames_in_flight`.
  std::vector<PassTime> pass_times(std::uint64_t frame);
  std::vector<std::byte> fetch(std::uint64_t frame, const ReadbackTicket& ticket);

 private:
  struct PoolBuffer {
    BufferDesc desc;
    std::unique_ptr<Buffer> buffer;
    std::uint64_t last_frame = 0;
  };
  struct PoolImage {
    ImageDesc desc;
    std::unique_ptr<ImageResource> image;
    std::uint64_t last_frame = 0;
  };
  struct Slot {
    std::uint64_t frame = 0;
    std::unique_ptr<Buffer> uploads;
    std::unique_ptr<Buffer> readbacks;
    std::map<std::uint32_t, std::uint64_t> readback_offsets;  // by buffer index of the graph
    VkDescriptorPool descriptors = VK_NULL_HANDLE;
    std::uint32_t descriptor_capacity = 0;
    std::map<std::pair<std::uint32_t, VkDescriptorSetLayout>, VkDescriptorSet> shared_sets;  // by ResourceSet
    VkQueryPool timestamps = VK_NULL_HANDLE;
    std::uint32_t timestamp_capacity = 0;
    std::vector<std::string> pass_names;
    std::vector<std::pair<ReadbackTicket, FrameGraph::Watcher>> watchers;  // not yet told
  };
  // The physical side of one declared resource in this frame.
  struct BufferBinding {
    Buffer* buffer = nullptr;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;
  };

  void find_pipelines(const FrameGraph& graph, const Plan& plan);
  void prepare_slot(Slot& slot, const FrameGraph& graph);
  void resolve_buffers(const FrameGraph& graph, const Plan& plan, Slot& slot);
  Buffer* find_history(const BufferResource& resource, std::uint32_t index);
  Buffer* find_transient(const BufferResource& resource, std::uint32_t index);
  void resolve_images(const FrameGraph& graph, const Plan& plan);
  void note_uses();
  void release_unused();
  void poison_new_buffers(const FrameGraph& graph, VkCommandBuffer commands);
  void record_barriers(const FrameGraph& graph, const std::vector<ResourceUse>& uses, VkCommandBuffer commands);
  void record_pass(const FrameGraph& graph, const Pass& pass, Slot& slot, VkCommandBuffer commands);
  void record_kind(const FrameGraph& graph, const ComputePass& pass, Slot& slot, VkCommandBuffer commands);
  void record_kind(const FrameGraph& graph, const RasterPass& pass, Slot& slot, VkCommandBuffer commands);
  void record_kind(const FrameGraph& graph, const BufferCopyPass& pass, Slot& slot, VkCommandBuffer commands);
  void record_kind(const FrameGraph& graph, const ImageCopyPass& pass, Slot& slot, VkCommandBuffer commands);
  void record_kind(const FrameGraph& graph, const FillPass& pass, Slot& slot, VkCommandBuffer commands);
  void record_kind(const FrameGraph& graph, const BuildPass& pass, Slot& slot, VkCommandBuffer commands);
  void record_draw(const RasterPass& pass, const Pipeline& pipeline, const DrawCall& draw, VkCommandBuffer commands);
  void record_final_layouts(const FrameGraph& graph, VkCommandBuffer commands);
  void bind_descriptors(const FrameGraph& graph, const ShaderPassBase& pass, const Pipeline& pipeline,
                        VkPipelineBindPoint point, Slot& slot, VkCommandBuffer commands);
  VkDescriptorSet find_shared_set(const FrameGraph& graph, const ShaderPassBase& pass, SetHandle set,
                                  VkDescriptorSetLayout layout, Slot& slot);
  std::vector<VkDescriptorBufferInfo> describe_pages(const BoundResource& resource) const;
  VkDescriptorSet write_descriptors(const FrameGraph& graph, const std::vector<BoundResource>& bound,
                                    VkDescriptorSetLayout layout, Slot& slot);
  Slot& completed_slot(std::uint64_t frame);

  Device& device_;
  FrameTimeline timeline_;  // before all resources: when it closes they have been let go of
  GraphContext context_;
  std::vector<Slot> slots_;
  std::uint64_t frame_ = 0;
  std::vector<PoolBuffer> buffer_pool_;
  std::vector<PoolImage> image_pool_;
  using HistorySide = std::pair<std::string, std::uint32_t>;  // name, side of a pair
  std::map<HistorySide, PoolBuffer> history_buffers_;
  std::map<HistorySide, PoolImage> history_images_;
  std::map<const ShaderPassBase*, const Pipeline*> pipelines_;  // of the frame being recorded
  std::vector<BufferBinding> buffers_;
  std::vector<std::uint32_t> new_buffers_;  // of these, those whose memory is new
  std::vector<ImageResource*> images_;
};

}  // namespace lightwell
