// What a host hands over each frame, checked before anything is made of it: a mistake becomes one line that names the
// field, not a stopped process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lightwell/renderer.h"

namespace lightwell {

class FrameCheck {
 public:
  // Takes notice of the instances that the renderer is made with. All throw InputError.
  FrameCheck(const Scene& scene, const SceneSnapshot& snapshot);

  void check(const FrameView& view) const;

 private:
  struct Shape {
    int mesh = -1;
    std::size_t joint_count = 0;
  };
  std::vector<Shape> shapes_;  // one an instance
};

void check_target(const Device& device, const RenderTarget& target);

// `recorded`: the number of the last frame that was recorded.
void check_completed(std::uint64_t completed, std::uint64_t recorded, std::uint32_t frames_in_flight);

}  // namespace lightwell
