// Which cell stands where in buffers of nested levels, written from the definition.
#pragma once

#include <compare>
#include <cstdint>

#include "passes/voxel_grid/voxel_levels.h"

namespace lightwell {

// A cell by its coordinates from VoxelLevels::origin, in its level's own size.
struct LevelCell {
  std::uint32_t level = 0;
  int x = 0, y = 0, z = 0;
  friend auto operator<=>(const LevelCell&, const LevelCell&) = default;
};

// The number in the window [lower, lower + side) that leaves `place` when divided by `side`.
inline int wrapped(int lower, int side, int place) {
  int at = lower - lower % side + place;
  return at < lower ? at + side : at;
}

inline LevelCell cell_of_index(const VoxelLevels& levels, std::uint32_t index) {
  const std::uint32_t side = levels.resolution;
  const std::uint32_t cells = side * side * side;
  const std::uint32_t level = levels.count - 1 - index / cells;
  const glm::ivec3 lower = level_lower(levels, level);
  const auto in_window = [&](int axis, std::uint32_t place) {
    return wrapped(lower[axis], static_cast<int>(side), static_cast<int>(place));
  };
  return {level, in_window(0, index % side), in_window(1, index / side % side),
          in_window(2, index % cells / side / side)};
}

// Of a cell inside its level's window.
inline std::uint32_t index_of_cell(const VoxelLevels& levels, const LevelCell& cell) {
  const std::uint32_t side = levels.resolution;
  const auto place = [&](int coordinate) { return static_cast<std::uint32_t>(coordinate) % side; };
  return (levels.count - 1 - cell.level) * side * side * side + (place(cell.z) * side + place(cell.y)) * side +
         place(cell.x);
}

inline bool shows(const VoxelLevels& levels, const LevelCell& cell) {
  const glm::ivec3 lower = level_lower(levels, cell.level);
  const auto inside = [&](int coordinate, int axis) {
    return coordinate >= lower[axis] && coordinate < lower[axis] + static_cast<int>(levels.resolution);
  };
  return inside(cell.x, 0) && inside(cell.y, 1) && inside(cell.z, 2);
}

}  // namespace lightwell
