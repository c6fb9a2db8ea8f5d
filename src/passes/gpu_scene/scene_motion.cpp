#include "passes/gpu_scene/scene_motion.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "lightwell/error.h"
#include "passes/gpu_scene/moving_parts.h"

namespace lightwell {

void SceneMotion::advance(const std::vector<FlatPart>& parts, const std::vector<bool>& animated,
                          const std::vector<MeshInstance>& now) {
  if (!instances) {
    moving = animated;
    moved.assign(parts.size(), false);
    still_frames.assign(parts.size(), 0);
    instances = std::make_shared<const std::vector<MeshInstance>>(now);
    return;
  }
  LW_ASSERT(now.size() == instances->size(), "snapshot has " + std::to_string(now.size()) + " instances, the scene " +
                                                 std::to_string(instances->size()));
  moved = list_moved_parts(parts, *instances, now);
  if (std::find(moved.begin(), moved.end(), true) != moved.end())
    instances = std::make_shared<const std::vector<MeshInstance>>(now);

  const bool may_return = frames_since_return >= kStillFramesUntilStatic;
  bool returned = false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    still_frames[i] = moved[i] ? 0 : std::min(still_frames[i] + 1, kStillFramesUntilStatic + 1);
    if (moved[i]) moving[i] = true;
    if (!moving[i] || animated[i] || !may_return || still_frames[i] <= kStillFramesUntilStatic) continue;
    moving[i] = false;
    returned = true;
  }
  frames_since_return = returned ? 0 : std::min(frames_since_return + 1, kStillFramesUntilStatic);
}

}  // namespace lightwell
