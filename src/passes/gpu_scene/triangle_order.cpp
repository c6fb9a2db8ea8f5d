#include "passes/gpu_scene/triangle_order.h"

#include <cstddef>

namespace lightwell {

OrderedTriangles order_triangles(const std::vector<FlatPart>& parts, const std::vector<std::uint32_t>& indices,
                                 const std::vector<bool>& moving) {
  OrderedTriangles ordered;
  ordered.indices.reserve(indices.size());
  const auto append = [&](bool has_holes, bool moves) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].has_holes != has_holes || moving[i] != moves) continue;
      ordered.parts.push_back(static_cast<std::uint32_t>(i));
      const auto triangle = static_cast<std::uint32_t>(ordered.indices.size() / 3);
      for (std::uint32_t t = 0; parts[i].emits && t < parts[i].index_count / 3; ++t)
        ordered.emissive.push_back(triangle + t);
      const auto first = indices.begin() + parts[i].first_index;
      ordered.indices.insert(ordered.indices.end(), first, first + parts[i].index_count);
    }
    return static_cast<std::uint32_t>(ordered.indices.size() / 3);
  };
  ordered.moving_first = append(false, false);
  ordered.opaque_triangle_count = append(false, true);
  ordered.moving_count = append(true, true) - ordered.moving_first;
  append(true, false);
  return ordered;
}

}  // namespace lightwell
