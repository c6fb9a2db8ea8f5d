// GPU times of passes over several frames.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "graph/executor.h"
#include "lightwell/renderer.h"

namespace lightwell {

// Takes each pass's mean over the frames that had it. The first frame a pass appears in counts only if there is no
// other: software drivers compile shaders then.
class PassClock {
 public:
  void add_frame(const std::vector<PassTime>& times);
  std::vector<PassStatistics> means() const;  // in order of first appearance
  double mean_frame_ms() const;               // all passes of a frame; the first one left out if possible

 private:
  struct Sum {
    std::string name;
    double first_ms = 0.0;
    double later_ms = 0.0;
    int later_frames = 0;
    std::uint32_t count = 0;
  };
  std::vector<Sum> sums_;
  double first_frame_ms_ = 0.0;
  double later_frames_ms_ = 0.0;
  int frames_ = 0;
  std::map<std::string, std::size_t> places_;
};

}  // namespace lightwell
