#include "passes/voxel_grid/voxel_levels.h"

#include <algorithm>
#include <string>

#include <glm/common.hpp>

#include "lightwell/error.h"

namespace lightwell {
namespace {

std::uint32_t cube(std::uint32_t side) {
  return side * side * side;
}

VoxelGrid coarsest_grid(const VoxelLevels& levels) {
  return level_grid(levels, levels.count - 1);
}

std::uint32_t count_levels(float coarsest_cell, const VoxelLevelSettings& settings) {
  const auto most = static_cast<std::uint32_t>(
      std::clamp<std::uint64_t>(settings.most_cells / cube(settings.resolution), 1, kMostLevels));
  std::uint32_t count = 1;
  float cell = coarsest_cell;
  constexpr std::uint32_t kLeastResolution = 4 * glsl::kLevelSnap;  // less leaves nothing between fading edges
  if (!(settings.finest_cell > 0.0f) || cell <= 2.0f * settings.finest_cell || settings.resolution < kLeastResolution)
    return count;
  for (; count < most && cell > settings.finest_cell; ++count) cell *= 0.5f;
  return count;
}

}  // namespace

VoxelLevels keep_voxel_levels(const std::optional<VoxelLevels>& last, const Bounds& bounds, const glm::vec3& focus,
                              const VoxelLevelSettings& settings) {
  LW_ASSERT(settings.resolution >= 1 && settings.resolution <= 1024,
            "resolution " + std::to_string(settings.resolution));
  std::optional<VoxelGrid> last_coarsest;
  if (last) last_coarsest = coarsest_grid(*last);
  const VoxelGrid coarsest = keep_voxel_grid(last_coarsest, bounds, settings.resolution);

  VoxelLevels levels{};
  levels.origin = coarsest.origin;
  levels.resolution = settings.resolution;
  levels.count = count_levels(coarsest.cell_size, settings);
  levels.cell_size = coarsest.cell_size / static_cast<float>(1u << (levels.count - 1));
  const auto cells = static_cast<float>(settings.resolution << (levels.count - 1));
  const glm::vec3 place = glm::clamp((focus - levels.origin) / levels.cell_size, 0.0f, cells - 1.0f);
  for (int axis = 0; axis < 3; ++axis)  // bounds that are not finite have no places
    levels.center[axis] = place[axis] >= 0.0f ? static_cast<int>(place[axis]) : 0;
  levels.focus = glm::clamp(focus, coarsest.origin, upper_corner(coarsest));
  return levels;
}

std::uint32_t count_cells(const VoxelLevels& levels) {
  return levels.count * cube(levels.resolution);
}

bool are_same_cells(const VoxelLevels& a, const VoxelLevels& b) {
  return a.origin == b.origin && a.cell_size == b.cell_size && a.resolution == b.resolution && a.count == b.count;
}

glm::ivec3 level_lower(const VoxelLevels& levels, std::uint32_t level) {
  const auto side = static_cast<int>(levels.resolution);
  const int last = (side << (levels.count - 1 - level)) - side;
  glm::ivec3 lower;
  for (int axis = 0; axis < 3; ++axis) {
    const int wanted = ((levels.center[axis] >> level) - side / 2 + glsl::kLevelSnap / 2) & ~(glsl::kLevelSnap - 1);
    lower[axis] = std::clamp(wanted, 0, last);
  }
  return lower;
}

VoxelGrid level_grid(const VoxelLevels& levels, std::uint32_t level) {
  VoxelGrid grid{};
  grid.cell_size = levels.cell_size * static_cast<float>(1u << level);
  grid.origin = levels.origin + glm::vec3(level_lower(levels, level)) * grid.cell_size;
  grid.resolution = glm::uvec3(levels.resolution);
  grid.cell_count = cube(levels.resolution);
  return grid;
}

}  // namespace lightwell
