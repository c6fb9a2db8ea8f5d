// Lists of rays whose tracing `lightwell rays` measures.
#pragma once

#include <string>
#include <vector>

#include "reference/ray_batch.h"

namespace lightwell {

struct RayList {
  std::string name;
  std::vector<BatchRay> rays;
};

// Each of `count` rays:
//   camera   through the pixels of a square picture, in tiles of 8x8: neighbours take almost the same way;
//   ambient  from what these see into the hemisphere, cosine-distributed: every ray goes its own way.
// The second list is empty where the camera sees nothing.
std::vector<RayList> make_ray_lists(const WorldCamera& camera, const RayTracer& tracer, int count);

}  // namespace lightwell
