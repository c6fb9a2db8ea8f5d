// Nested grids about a point of interest for the octree: the levels of passes/voxel_grid/voxel_levels.h, whose windows
// move in steps large enough for the tree. A window's borders lie between cells that are eight times as large as the
// next coarser level's, so that each of its cells, of each size that a list may fall back to, lies inside or outside.
#pragma once

#include <array>
#include <cstdint>

#include "passes/voxel_grid/voxel_levels.h"

namespace lightwell {

struct SvoLevels {
  VoxelLevels levels{};
  // Of each level's window: its lowest cell, level 0 being the finest. A multiple of kSvoSnap.
  std::array<glm::ivec3, kMostLevels> lower{};
};

inline constexpr int kSvoSnap = 16;  // cells

// About `focus`, `resolution` cells a side of each level: a power of two, 8 to 1024. Levels are added until cells are
// no larger than `finest_cell`, m; 0: one grid, as fit_voxel_grid() lays it. A window stays where it was in `last`, if
// given, until the focus is an eighth of its side from its middle.
SvoLevels keep_svo_levels(const SvoLevels* last, const Bounds& bounds, const glm::vec3& focus, std::uint32_t resolution,
                          float finest_cell);

// Whether both have the same cells and windows.
bool is_same(const SvoLevels& a, const SvoLevels& b);
// The cells of a level's window.
VoxelGrid level_grid(const SvoLevels& levels, std::uint32_t level);
// World position of the lower corner of the finest cell that holds the focus.
glm::vec3 center_corner(const SvoLevels& levels);

}  // namespace lightwell
