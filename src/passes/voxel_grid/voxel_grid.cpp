#include "passes/voxel_grid/voxel_grid.h"

#include <algorithm>
#include <string>

#include <glm/geometric.hpp>

#include "lightwell/error.h"

namespace lightwell {

VoxelGrid fit_voxel_grid(const Bounds& bounds, std::uint32_t resolution) {
  LW_ASSERT(resolution >= 1 && resolution <= 1024, "resolution " + std::to_string(resolution));
  constexpr float kMarginCells = 1.0f / 256.0f;

  const glm::vec3 extent = bounds.maximum - bounds.minimum;
  // Scenes without extent get what single precision tells apart where they are.
  const float farthest = std::max(glm::length(bounds.minimum), glm::length(bounds.maximum));
  const float longest = std::max({extent.x, extent.y, extent.z, 1e-5f * farthest, 1e-6f});
  const auto cells = static_cast<float>(resolution);

  VoxelGrid grid{};
  grid.cell_size = longest / (cells - 2.0f * kMarginCells);
  grid.resolution = glm::uvec3(resolution);
  grid.cell_count = resolution * resolution * resolution;
  const glm::vec3 center = bounds.minimum + 0.5f * extent;
  grid.origin = center - glm::vec3(0.5f * cells * grid.cell_size);
  return grid;
}

glm::vec3 upper_corner(const VoxelGrid& grid) {
  return grid.origin + glm::vec3(grid.resolution) * grid.cell_size;
}

}  // namespace lightwell
