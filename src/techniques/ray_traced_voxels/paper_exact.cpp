#include "techniques/ray_traced_voxels/paper_exact.h"

#include "kernels/techniques/ray_traced_voxels/paper_touched.comp.h"
#include "techniques/ray_traced_voxels/paper_types.h"

namespace lightwell {

ExactSums record_exact_sums(FrameGraph& graph, std::uint32_t cell_count) {
  constexpr std::uint32_t kWord = sizeof(std::uint32_t);
  ExactSums sums;
  bool fresh = false;
  bool fresh_high = false;
  sums.low = graph.history_buffer("exact sums", cell_count, 4 * kWord, fresh);
  sums.high =
      graph.history_buffer("exact high sums", std::uint64_t{glsl::kExactHighWords} * cell_count, kWord, fresh_high);
  if (fresh) graph.fill("ray-traced voxels: clear sums", sums.low, 0);
  if (fresh_high) graph.fill("ray-traced voxels: clear sums", sums.high, 0);
  sums.touched = graph.create_buffer("exact voxels", cell_count, kWord);
  sums.touched_count = graph.create_buffer("exact voxel counts", glsl::kTouchedWords, kWord);
  return sums;
}

void record_empty_list(FrameGraph& graph, std::string_view name, ExactSums& sums) {
  graph.fill(name, sums.touched_count, 0);
}

void record_touched_groups(FrameGraph& graph, std::string_view name, ExactSums& sums) {
  graph.compute(name, kernels::ray_traced_voxels_paper_touched_comp)
      .write("touched_count", sums.touched_count)
      .dispatch(1);
}

void take_exact_sums(ComputePass& pass, ExactSums& sums) {
  pass.write("sums", sums.low)
      .write("high_sums", sums.high)
      .read("touched", sums.touched)
      .read("touched_count", sums.touched_count)
      .dispatch_indirect(sums.touched_count, glsl::kTouchedGroups * sizeof(std::uint32_t));
}

}  // namespace lightwell
