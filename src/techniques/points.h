// Places away from the screen that a pass asks a technique about.
#pragma once

#include <cstdint>

#include "graph/frame_graph.h"

namespace lightwell {

struct Points {
  BufferHandle points;      // glsl::SurfacePoint (shaders/surface_point.h)
  std::uint32_t count = 0;  // of the buffer's elements, those that count
};

}  // namespace lightwell
