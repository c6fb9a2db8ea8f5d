// What the exact writer keeps: sums of every voxel, which are 0 between its uses, and a list of the voxels in use.
#pragma once

#include <cstdint>
#include <string_view>

#include "graph/frame_graph.h"

namespace lightwell {

struct ExactSums {
  BufferHandle low;            // uvec4 a voxel: red, green, blue, number of samples
  BufferHandle high;           // kExactHighWords a voxel
  BufferHandle touched;        // uint: voxels in use
  BufferHandle touched_count;  // words: paper_types.h
};

// Of this frame, to be asked for once. The sums are a history: cleared here where it is fresh, and else by their users.
ExactSums record_exact_sums(FrameGraph& graph, std::uint32_t cell_count);

// Before a use: the list is empty. `name`: of the pass.
void record_empty_list(FrameGraph& graph, std::string_view name, ExactSums& sums);

// Binds all to a pass that writes samples.
template <class Pass>
Pass& write_exact_sums(Pass& pass, ExactSums& sums) {
  return pass.write("sums", sums.low)
      .write("high_sums", sums.high)
      .write("touched", sums.touched)
      .write("touched_count", sums.touched_count);
}

// After a use: counts the groups of the pass that follows, take_exact_sums(), which runs one invocation a voxel of the
// list, takes what its sums hold and clears them.
void record_touched_groups(FrameGraph& graph, std::string_view name, ExactSums& sums);
void take_exact_sums(ComputePass& pass, ExactSums& sums);

}  // namespace lightwell
