#include "passes/voxel_grid/voxel_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

// In cells from the grid's lower corner.
glm::vec3 coordinates(const VoxelGrid& grid, glm::vec3 position) {
  return (position - grid.origin) / grid.cell_size;
}

TEST(VoxelGrid, LongestAxisSpansTheResolution) {
  const VoxelGrid grid = fit_voxel_grid({{-1.0f, 0.0f, 2.0f}, {3.0f, 2.5f, 3.0f}}, 32);
  EXPECT_EQ(grid.resolution, glm::uvec3(32));
  EXPECT_EQ(grid.cell_count, 32u * 32u * 32u);
  EXPECT_NEAR(grid.cell_size, 4.0f / 32.0f, 1e-4f);
  const glm::vec3 center = 0.5f * (grid.origin + upper_corner(grid));
  EXPECT_NEAR(center.x, 1.0f, 1e-5f);
  EXPECT_NEAR(center.y, 1.25f, 1e-5f);
  EXPECT_NEAR(center.z, 2.5f, 1e-5f);
}

TEST(VoxelGrid, SurfacesOnTheBoundsAreInsideTheOuterCells) {
  for (const float offset : {0.0f, 3.7f, -250.0f}) {
    for (const std::uint32_t resolution : {8u, 32u, 128u, 256u}) {
      const Bounds bounds{glm::vec3(offset), glm::vec3(offset + 7.3f)};
      const VoxelGrid grid = fit_voxel_grid(bounds, resolution);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(std::floor(coordinates(grid, bounds.minimum)[axis]), 0.0f);
        EXPECT_EQ(std::floor(coordinates(grid, bounds.maximum)[axis]), static_cast<float>(resolution) - 1.0f);
      }
    }
  }
}

// A room twice as long as high has floor and ceiling on cell walls: both must fall in the cells inside the room.
TEST(VoxelGrid, SurfacesOnCellWallsFallInside) {
  const Bounds bounds{{0.0f, 0.0f, 0.0f}, {8.0f, 4.0f, 8.0f}};
  const VoxelGrid grid = fit_voxel_grid(bounds, 32);
  EXPECT_EQ(std::floor(coordinates(grid, bounds.minimum).y), 8.0f);
  EXPECT_EQ(std::floor(coordinates(grid, bounds.maximum).y), 23.0f);
}

TEST(VoxelGrid, BoundsWithoutExtentGiveAUsableGrid) {
  const VoxelGrid grid = fit_voxel_grid({{1.0f, 2.0f, 3.0f}, {1.0f, 2.0f, 3.0f}}, 16);
  EXPECT_GT(grid.cell_size, 0.0f);
  const glm::vec3 at = coordinates(grid, {1.0f, 2.0f, 3.0f});
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GE(at[axis], 0.0f);
    EXPECT_LT(at[axis], 16.0f);
  }
}

TEST(VoxelGrid, StaysWhereItIsWhileItHoldsWhatMoves) {
  const Bounds bounds{glm::vec3(-1.0f), glm::vec3(3.0f)};
  const VoxelGrid fitted = fit_voxel_grid(bounds, 32);
  EXPECT_TRUE(is_same_grid(keep_voxel_grid({}, bounds, 32), fitted));
  EXPECT_TRUE(is_same_grid(keep_voxel_grid(fitted, {glm::vec3(-0.9f), glm::vec3(2.5f)}, 32), fitted));
  EXPECT_FALSE(is_same_grid(keep_voxel_grid(fitted, bounds, 33), fitted));

  // What leaves it gets room to spare, so that it may go on.
  const VoxelGrid larger = keep_voxel_grid(fitted, {glm::vec3(-1.0f), glm::vec3(3.1f)}, 32);
  EXPECT_FALSE(is_same_grid(larger, fitted));
  EXPECT_TRUE(is_same_grid(keep_voxel_grid(larger, {glm::vec3(-1.3f), glm::vec3(3.4f)}, 32), larger));
  // Where little of it is used it shrinks.
  const Bounds small{glm::vec3(0.0f), glm::vec3(2.0f)};
  EXPECT_TRUE(is_same_grid(keep_voxel_grid(fitted, small, 32), fit_voxel_grid(small, 32)));
}

}  // namespace
}  // namespace lightwell
