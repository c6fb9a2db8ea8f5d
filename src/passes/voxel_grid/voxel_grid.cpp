#include "passes/voxel_grid/voxel_grid.h"

#include <algorithm>
#include <string>

#include <glm/geometric.hpp>

#include "lightwell/error.h"

namespace lightwell {
namespace {

bool holds(const VoxelGrid& grid, const Bounds& bounds) {
  const glm::vec3 upper = upper_corner(grid);
  for (int axis = 0; axis < 3; ++axis)
    if (bounds.minimum[axis] < grid.origin[axis] || bounds.maximum[axis] > upper[axis]) return false;
  return true;
}

}  // namespace

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

VoxelGrid keep_voxel_grid(const std::optional<VoxelGrid>& last, const Bounds& bounds, std::uint32_t resolution) {
  constexpr float kWorthShrinking = 0.7f;
  constexpr float kRoomToSpare = 0.1f;
  const VoxelGrid fitted = fit_voxel_grid(bounds, resolution);
  const bool comparable =
      last && last->resolution.x == resolution && fitted.cell_size > kWorthShrinking * last->cell_size;
  if (!comparable) return fitted;
  if (holds(*last, bounds)) return *last;
  const glm::vec3 spare(kRoomToSpare * fitted.cell_size * static_cast<float>(resolution));
  return fit_voxel_grid({bounds.minimum - spare, bounds.maximum + spare}, resolution);
}

bool is_same_grid(const VoxelGrid& a, const VoxelGrid& b) {
  return a.origin == b.origin && a.cell_size == b.cell_size && a.resolution == b.resolution;
}

glm::vec3 upper_corner(const VoxelGrid& grid) {
  return grid.origin + glm::vec3(grid.resolution) * grid.cell_size;
}

}  // namespace lightwell
