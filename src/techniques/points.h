// Places away from the screen at which a pass looks up a technique's irradiance.
#pragma once

#include <cstdint>

#include "graph/frame_graph.h"

namespace lightwell {

struct Points {
  BufferHandle points;      // glsl::SurfacePoint (shaders/surface_point.h)
  std::uint32_t count = 0;  // of the buffer's elements, those that count
};

}  // namespace lightwell
