// Buffers beyond what one descriptor reaches are bound in pages: shaders/paged_buffer.glsl.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "graph/handles.h"

namespace lightwell {

inline constexpr std::uint32_t kMaximumPages = 4;  // the length of the shaders' arrays of blocks

struct Pages {
  std::uint64_t count = 1;
  std::uint64_t bytes = 0;   // of each but the last
  std::uint32_t shift = 31;  // log2 of its elements
};

// One page where the buffer fits into a descriptor, which reaches `range` bytes; otherwise each holds a power of two of
// elements.
constexpr Pages divide_into_pages(const BufferDesc& desc, std::uint64_t range) {
  if (desc.size <= range) return {1, desc.size, 31};
  const std::uint64_t stride = std::max(desc.stride, 1u);
  const std::uint64_t elements = std::bit_floor(range / stride);
  return {(desc.size + elements * stride - 1) / (elements * stride), elements * stride,
          static_cast<std::uint32_t>(std::countr_zero(elements))};
}

}  // namespace lightwell
