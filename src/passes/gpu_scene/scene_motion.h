// Which parts of the scene move, frame by frame.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lightwell/scene.h"
#include "passes/gpu_scene/flatten.h"

namespace lightwell {

// After so many frames without movement a part that no animation moves counts as static again. Parts return together:
// one return begins no sooner than as many frames after the last, so that bodies that come to rest one by one cost few
// rebuilds of what is kept of the static triangles.
inline constexpr std::uint32_t kStillFramesUntilStatic = 30;

// The motion of all parts at one frame: a function of the poses in the frames up to it. Vectors hold one entry a part.
struct SceneMotion {
  std::shared_ptr<const std::vector<MeshInstance>> instances;  // in their poses; none before the first frame
  std::vector<bool> moved;                                     // since the frame before
  std::vector<bool> moving;                                    // animated, or moved not long ago
  std::vector<std::uint32_t> still_frames;                     // without movement, this one included
  std::uint32_t frames_since_return = kStillFramesUntilStatic;

  // Goes on to the frame that shows `now`: the same instances, where they are then. `animated` (one a part): those that
  // always count as moving (list_animated_parts()).
  void advance(const std::vector<FlatPart>& parts, const std::vector<bool>& animated,
               const std::vector<MeshInstance>& now);
};

}  // namespace lightwell
