// Prefix sums and a stable radix sort on the device, without atomics: the same input gives the same output.
#pragma once

#include <cstdint>
#include <string_view>

#include "graph/frame_graph.h"

namespace lightwell {

// The sum of the elements before element i is sums[i] + blocks[i / glsl::kScanBlock].x (passes/sort/sort_types.h).
struct PrefixSums {
  BufferHandle sums;    // uint an element
  BufferHandle blocks;  // uvec2 a block; y: 0
};

// Of the first `count` uints of `elements`.
PrefixSums record_prefix_sums(FrameGraph& graph, std::string_view name, BufferHandle elements, std::uint32_t count);

// Sorts the first `count` of `keys` (uvec2: x key, y whatever belongs to it) by the lowest `bits` bits of x, rounded up
// to whole bytes. Equal keys keep their order.
BufferHandle record_sort(FrameGraph& graph, std::string_view name, BufferHandle keys, std::uint32_t count,
                         std::uint32_t bits);

}  // namespace lightwell
