// Buffers beyond what one descriptor may reach, in pages that shaders see as an array of blocks (shaders/paged.glsl).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "graph/handles.h"

namespace lightwell {

struct PageLimits {
  std::uint64_t largest_range = std::uint64_t{128} << 20;  // bytes that one descriptor may reach: maxStorageBufferRange
  std::uint64_t page_bytes = std::uint64_t{128} << 20;     // of a page at most; no device's limit is less
};

inline constexpr std::uint32_t kMaximumPages = 4;  // of one buffer in a shared set

struct Pages {
  std::uint32_t count = 1;
  std::uint64_t bytes = 0;  // of each but the last
  std::uint32_t shift = 0;  // log2 of its elements
};

// One page where the buffer fits into a descriptor; otherwise each holds a power of two of elements.
constexpr Pages divide_into_pages(const BufferDesc& desc, const PageLimits& limits) {
  if (desc.size <= limits.largest_range) return {1, desc.size, 31};
  const std::uint64_t stride = std::max(desc.stride, 1u);
  const std::uint64_t elements = std::bit_floor(limits.page_bytes / stride);
  return {static_cast<std::uint32_t>((desc.size + elements * stride - 1) / (elements * stride)), elements * stride,
          static_cast<std::uint32_t>(std::countr_zero(elements))};
}

}  // namespace lightwell
