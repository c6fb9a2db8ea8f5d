#include "passes/svo/svo_levels.h"

#include <algorithm>
#include <cstdlib>

namespace lightwell {
namespace {

// Of all levels: entries of the octree's list have 32 bits for level and cell.
constexpr std::uint64_t kMostCells = std::uint64_t{1} << 32;

// Where the window is to begin along one axis; `center`: the focus, in its cells.
int find_lower(int center, int side, const int* last) {
  const int most_away = std::max(3 * kSvoSnap / 4, side / 8);
  if (last != nullptr && std::abs(center - (*last + side / 2)) <= most_away) return *last;
  return (center - side / 2 + kSvoSnap / 2) & ~(kSvoSnap - 1);
}

// In double precision: what is near the focus has small numbers, whatever those of the levels' origin.
glm::vec3 place_of(const VoxelLevels& levels, const glm::ivec3& cell, std::uint32_t level) {
  glm::vec3 place;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = double{levels.cell_size} * static_cast<double>(1u << level);
    place[axis] = static_cast<float>(double{levels.origin[axis]} + static_cast<double>(cell[axis]) * size);
  }
  return place;
}

}  // namespace

SvoLevels keep_svo_levels(const SvoLevels* last, const Bounds& bounds, const glm::vec3& focus, std::uint32_t resolution,
                          float finest_cell) {
  const VoxelLevelSettings settings{.resolution = resolution, .finest_cell = finest_cell, .most_cells = kMostCells};
  SvoLevels kept;
  kept.levels = keep_voxel_levels({}, bounds, focus, settings);
  if (kept.levels.count == 1) {
    kept.levels.center = glm::ivec3(0);
    return kept;
  }
  if (last != nullptr) kept.levels = keep_voxel_levels(last->levels, bounds, focus, settings);
  const bool same_cells = last != nullptr && are_same_cells(last->levels, kept.levels);
  const int side = static_cast<int>(resolution);
  for (std::uint32_t level = kept.levels.count - 1; level-- > 0;) {
    for (int axis = 0; axis < 3; ++axis) {
      const int* before = same_cells ? &last->lower[level][axis] : nullptr;
      const int outer = 2 * kept.lower[level + 1][axis];
      kept.lower[level][axis] =
          std::clamp(find_lower(kept.levels.center[axis] >> level, side, before), outer, outer + side);
    }
  }
  return kept;
}

bool is_same(const SvoLevels& a, const SvoLevels& b) {
  return are_same_cells(a.levels, b.levels) && a.lower == b.lower;
}

VoxelGrid level_grid(const SvoLevels& levels, std::uint32_t level) {
  VoxelGrid grid = level_grid(levels.levels, level);
  grid.origin = place_of(levels.levels, levels.lower[level], level);
  return grid;
}

glm::vec3 center_corner(const SvoLevels& levels) {
  return place_of(levels.levels, levels.levels.center, 0);
}

}  // namespace lightwell
