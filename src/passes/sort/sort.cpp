#include "passes/sort/sort.h"

#include <string>

#include "graph/linear_dispatch.h"
#include "kernels/passes/sort/scan_elements.comp.h"
#include "kernels/passes/sort/scan_totals.comp.h"
#include "kernels/passes/sort/sort_count.comp.h"
#include "kernels/passes/sort/sort_scatter.comp.h"
#include "passes/sort/sort_params.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kWord = sizeof(std::uint32_t);

std::uint32_t divide_up(std::uint32_t a, std::uint32_t b) {
  return (a + b - 1) / b;
}

}  // namespace

PrefixSums record_prefix_sums(FrameGraph& graph, std::string_view name, BufferHandle elements, std::uint32_t count) {
  const std::uint32_t blocks = divide_up(count, glsl::kScanBlock);
  const std::string label(name);
  PrefixSums result{graph.create_buffer(label + " sums", count, kWord),
                    graph.create_buffer(label + " sums of blocks", blocks, sizeof(glm::uvec2))};
  const glsl::SortParams params{count, 0};
  dispatch_linear(graph.compute(label, kernels::sort_scan_elements_comp)
                      .read("elements", elements)
                      .write("sums", result.sums)
                      .write("blocks", result.blocks)
                      .push(params),
                  blocks);
  graph.compute(label, kernels::sort_scan_totals_comp).write("blocks", result.blocks).push(params).dispatch(1);
  return result;
}

BufferHandle record_sort(FrameGraph& graph, std::string_view name, BufferHandle keys, std::uint32_t count,
                         std::uint32_t bits) {
  const std::uint32_t chunks = divide_up(count, glsl::kSortChunk);
  const std::uint32_t count_words = chunks << glsl::kSortBits;
  const std::string label(name);
  for (std::uint32_t shift = 0; shift < bits; shift += glsl::kSortBits) {
    const glsl::SortParams params{count, shift};
    BufferHandle counts = graph.create_buffer(label + " digits", count_words, kWord);
    dispatch_linear(
        graph.compute(label, kernels::sort_sort_count_comp).read("keys", keys).write("counts", counts).push(params),
        chunks, 8);
    PrefixSums places = record_prefix_sums(graph, label, counts, count_words);
    BufferHandle sorted = graph.create_buffer(label + " sorted", count, sizeof(glm::uvec2));
    dispatch_linear(graph.compute(label, kernels::sort_sort_scatter_comp)
                        .read("keys", keys)
                        .write("places", places.sums)
                        .read("blocks", places.blocks)
                        .write("sorted", sorted)
                        .push(params),
                    chunks, 8);
    keys = sorted;
  }
  return keys;
}

}  // namespace lightwell
