// What outlives a frame on the declaring side: which histories there are and what they hold, and shader reflections.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "gpu/kernel_code.h"
#include "gpu/reflection.h"
#include "graph/handles.h"

namespace lightwell {

// Of one name: a plain history, or a pair whose two sides take turns.
template <class Desc>
struct HistoryState {
  Desc desc;
  std::uint64_t written = 0;    // pair: the last frame that wrote its current side; 0: none
  std::uint32_t last_side = 0;  // pair: the side that it wrote
};

// Owned by the executor, or by a test. Changes only when a frame has been recorded.
class GraphContext {
 public:
  const Reflection& reflection(const KernelCode& code);
  // A frame was declared and dropped.
  void forget_histories();

  std::map<std::string, HistoryState<BufferDesc>> history_buffers;  // by name, scope included
  std::map<std::string, HistoryState<ImageDesc>> history_images;
  std::uint64_t frames_recorded = 0;
  std::uint64_t descriptor_range = std::uint64_t{128} << 20;  // bytes that the descriptor of a storage buffer reaches

 private:
  std::map<const std::uint32_t*, Reflection> reflections_;
};

}  // namespace lightwell
