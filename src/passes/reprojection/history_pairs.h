// Images of last frame beside the same images of this one.
#pragma once

#include <string>
#include <string_view>

#include "graph/frame_graph.h"

namespace lightwell {

struct HistoryPair {
  ImageHandle previous;
  ImageHandle current;
  bool valid = false;  // `previous` is what the last frame wrote
};

// Each image is two that take turns. One object for each owner of histories.
class HistoryPairs {
 public:
  // Call once a frame, before image().
  void begin_frame() { odd_ = !odd_; }

  HistoryPair image(FrameGraph& graph, std::string_view name, const ImageDesc& desc) const {
    bool fresh[2];
    HistoryPair pair;
    pair.previous = graph.history_image(std::string(name) + (odd_ ? " even" : " odd"), desc, fresh[0]);
    pair.current = graph.history_image(std::string(name) + (odd_ ? " odd" : " even"), desc, fresh[1]);
    pair.valid = !fresh[0];
    return pair;
  }

 private:
  bool odd_ = false;
};

}  // namespace lightwell
