// Fits nested grids to a scene.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_int3.hpp>

#include "lightwell/scene.h"
#include "passes/voxel_grid/voxel_grid.h"
#include "passes/voxel_grid/voxel_levels_types.h"

namespace lightwell {

using VoxelLevels = glsl::VoxelLevels;

// Cells of all levels where each has a key: 8 times its number and a direction, in 28 bits.
inline constexpr std::uint32_t kMostLevelCells = (1u << 25) - 8;
inline constexpr std::uint32_t kMostLevels = 20;

struct VoxelLevelSettings {
  std::uint32_t resolution = 64;               // cells a side of each level, [1, 1024]
  float finest_cell = 0.0f;                    // m: levels are added until cells are no larger; 0: one grid
  std::uint64_t most_cells = kMostLevelCells;  // of all levels; one grid there always is
};

// `last`: those of the frame before. The coarsest level is kept as keep_voxel_grid() keeps a grid. Where its cells are
// at most twice as large as the finest are to be, it is the only one. No more levels than kMostLevels.
VoxelLevels keep_voxel_levels(const std::optional<VoxelLevels>& last, const Bounds& bounds, const glm::vec3& focus,
                              const VoxelLevelSettings& settings);

// Of all levels.
std::uint32_t count_cells(const VoxelLevels& levels);
// Whether cells have the same places and numbers in both, wherever their windows lie.
bool are_same_cells(const VoxelLevels& a, const VoxelLevels& b);
// As the functions of voxel_levels_types.h.
glm::ivec3 level_lower(const VoxelLevels& levels, std::uint32_t level);
VoxelGrid level_grid(const VoxelLevels& levels, std::uint32_t level);

}  // namespace lightwell
