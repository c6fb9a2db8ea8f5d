// In which order the scene's triangles are drawn: whoever wants the opaque ones, or those that move, finds them in one
// range.
#pragma once

#include <cstdint>
#include <vector>

#include "passes/gpu_scene/flatten.h"

namespace lightwell {

struct OrderedTriangles {
  std::vector<std::uint32_t> indices;       // opaque standing, opaque moving, moving with holes, standing with holes
  std::vector<std::uint32_t> parts;         // in the order of their triangles
  std::vector<std::uint32_t> emissive;      // triangles that emit light, rising
  std::uint32_t opaque_triangle_count = 0;  // of the first triangles
  std::uint32_t moving_first = 0;           // triangles
  std::uint32_t moving_count = 0;
};

// `moving`: one a part.
OrderedTriangles order_triangles(const std::vector<FlatPart>& parts, const std::vector<std::uint32_t>& indices,
                                 const std::vector<bool>& moving);

}  // namespace lightwell
