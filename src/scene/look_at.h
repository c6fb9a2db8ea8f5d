// A camera by where it is and what it looks at.
#pragma once

#include "lightwell/scene.h"

namespace lightwell {

// A camera at `eye` that looks at `target`, another point, upright where it can be: straight up or down there is no
// horizon, and -Z is up, as on a map. Vertical field of view 45 degrees; it sees past all of `bounds` (metres).
WorldCamera look_at(const glm::vec3& eye, const glm::vec3& target, const Bounds& bounds);

}  // namespace lightwell
