// Recorded hits, written again by each writer alone: what writing costs without tracing, and what it leaves. For tests.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <vector>

#include "gpu/submit.h"
#include "graph/executor.h"
#include "techniques/ray_traced_voxels/paper_passes.h"

namespace lightwell {

inline constexpr std::array<VoxelWriter, 4> kAllWriters{VoxelWriter::kAverage, VoxelWriter::kMaximum,
                                                        VoxelWriter::kNone, VoxelWriter::kExact};

struct ReplayTime {
  double write_ms = 1e30;
  double rest_ms = 1e30;  // clearing before it, and means from sums after it
};

class HitReplay {
 public:
  // `record`: declares the passes that make the hits, in the first frame only.
  HitReplay(Device& device, std::uint32_t hit_count, std::uint32_t cell_count, float range,
            std::function<BufferHandle(FrameGraph&)> record)
      : executor_(device),
        submitter_(device),
        hit_count_(hit_count),
        cell_count_(cell_count),
        range_(range),
        record_(std::move(record)) {}

  // Buffers beyond are bound in pages.
  void limit_descriptor_range(std::uint64_t bytes) { executor_.context().descriptor_range = bytes; }

  std::vector<glsl::VoxelHit> hits() {
    return run<glsl::VoxelHit>([&](FrameGraph& graph) { return kept_hits(graph); });
  }

  // The grid that a writer leaves: RGBA8 words, or the bits of the exact writer's floats.
  std::vector<std::uint32_t> write(VoxelWriter writer) {
    return run<std::uint32_t>([&](FrameGraph& graph) {
      ExactSums sums = writer == VoxelWriter::kExact ? record_exact_sums(graph, cell_count_) : ExactSums{};
      const PaperInjection settings{.writer = writer, .range = range_};
      VoxelTarget target = begin_target(graph, cell_count_, settings, sums);
      write_hits(graph, kept_hits(graph), hit_count_, settings, target, sums);
      BufferHandle sum;
      end_target(graph, target, cell_count_, settings, sums, sum);
      return sum;
    });
  }

  // The least of `repeats`, in which the writers take turns; by VoxelWriter.
  std::array<ReplayTime, 4> time(int repeats) {
    std::array<ReplayTime, 4> least;
    for (int repeat = 0; repeat <= repeats; ++repeat) {
      for (const VoxelWriter writer : kAllWriters) {
        write(writer);
        if (repeat == 0) continue;  // drivers compile at the first dispatch
        ReplayTime now{0.0, 0.0};
        for (const PassTime& pass : executor_.pass_times(frame_)) {
          if (!pass.name.starts_with("ray-traced voxels: inject")) continue;
          (pass.name.ends_with(": write") ? now.write_ms : now.rest_ms) += pass.time_ms;
        }
        ReplayTime& best = least[static_cast<std::size_t>(writer)];
        best = {std::min(best.write_ms, now.write_ms), std::min(best.rest_ms, now.rest_ms)};
      }
    }
    return least;
  }

 private:
  BufferHandle kept_hits(FrameGraph& graph) {
    bool fresh = false;
    BufferHandle kept = graph.history_buffer("replay hits", hit_count_, sizeof(glsl::VoxelHit), fresh);
    if (fresh) graph.copy("keep hits", record_(graph), kept, std::uint64_t{hit_count_} * sizeof(glsl::VoxelHit));
    return kept;
  }

  template <class T, class Declare>
  std::vector<T> run(const Declare& declare) {
    FrameGraph graph(executor_.context());
    const ReadbackTicket ticket = graph.read_back(declare(graph));
    submitter_.run([&](VkCommandBuffer commands) { frame_ = executor_.record(graph, commands, frame_); });
    const std::vector<std::byte> bytes = executor_.fetch(frame_, ticket);
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
  }

  GraphExecutor executor_;
  Submitter submitter_;
  std::uint32_t hit_count_;
  std::uint32_t cell_count_;
  float range_;
  std::function<BufferHandle(FrameGraph&)> record_;
  std::uint64_t frame_ = 0;
};

}  // namespace lightwell
