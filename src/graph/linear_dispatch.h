// Long one-dimensional dispatches, folded into rows (shaders/linear_dispatch.glsl).
#pragma once

#include <algorithm>
#include <cstdint>

#include "graph/frame_graph.h"

namespace lightwell {

// Runs a kernel that uses linear_invocation() with at least `count` invocations; its workgroups are `group_size` x 1
// x 1.
inline void dispatch_linear(ComputePass& pass, std::uint64_t count, std::uint32_t group_size = 64) {
  constexpr std::uint64_t kLongestRow = 32768;
  const std::uint64_t groups = (count + group_size - 1) / group_size;
  const std::uint64_t row = std::clamp<std::uint64_t>(groups, 1, kLongestRow);
  pass.dispatch(static_cast<std::uint32_t>(row), static_cast<std::uint32_t>((groups + row - 1) / row));
}

}  // namespace lightwell
