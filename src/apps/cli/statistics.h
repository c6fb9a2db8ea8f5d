// What a render cost, as text or JSON.
#pragma once

#include <string>

#include "lightwell/renderer.h"

namespace lightwell {

// {"device", "frames", "steady", "frame_ms", "wall_ms", "memory_bytes", "passes": [{"name", "ms", "count"}],
//  "memory": [{"name", "bytes"}], "triangles", "vertices", "lights"}
std::string statistics_as_json(const RenderStatistics& statistics, const std::string& device);

// A table for people.
std::string statistics_as_text(const RenderStatistics& statistics, const std::string& device);

}  // namespace lightwell
