// Areas of surfaces in faces against polygon clipping in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <glm/geometric.hpp>

#include "passes/voxel_faces/testing/faces_test_base.h"
#include "passes/voxelize/testing/clip_oracle.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 31;
constexpr double kUnits = double{glsl::kFaceAreaUnits};

using Triangle64 = std::array<glm::dvec3, 3>;

Triangle64 in_cells(const VoxelGrid& grid, const Corners& corners) {
  Triangle64 t;
  for (std::size_t i = 0; i < 3; ++i)
    t[i] = (glm::dvec3(corners[i]) - glm::dvec3(grid.origin)) / double{grid.cell_size};
  return t;
}

double sum_areas(const FrameFaces& shown) {
  double sum = 0.0;
  for (const std::uint32_t area : shown.areas) sum += area / kUnits;
  return sum;
}

TestTriangles triangles_inside(const VoxelGrid& grid, int count) {
  TestTriangles test;
  const glm::vec3 upper = upper_corner(grid);
  for (const Corners& corners : random_triangles(grid, kSeed, count))
    if (std::all_of(corners.begin(), corners.end(), [&](const glm::vec3& c) {
          return glm::all(glm::greaterThan(c, grid.origin)) && glm::all(glm::lessThan(c, upper));
        }))
      test.triangles.push_back(corners);
  return test;
}

// Both sides of what is inside the grid, whatever walls between cells it lies in.
TEST_F(VoxelFacesTest, AreasAddUpToThoseOfTheTriangles) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  for (const std::uint32_t resolution : {16u, 64u}) {
    const VoxelGrid grid = fit_voxel_grid(kUnit, resolution);
    const TestTriangles test = triangles_inside(grid, 600);
    double expected = 0.0;
    for (const Corners& corners : test.triangles) {
      const Triangle64 t = in_cells(grid, corners);
      expected += glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
    }
    VoxelFaceMemory memory;
    const FrameFaces shown = show(test, kUnit, {.levels = {.resolution = resolution}, .areas = true}, memory);
    EXPECT_GT(expected, 100.0);
    EXPECT_NEAR(sum_areas(shown), expected, 1e-3 * expected);
  }
}

TEST_F(VoxelFacesTest, EveryFaceHasTheAreaOfItsPieces) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const VoxelGrid grid = fit_voxel_grid(kUnit, 16);
  TestTriangles test = triangles_inside(grid, 800);
  // Corners on a lattice are in walls between cells, where the oracle would count both sides.
  std::erase_if(test.triangles, [&](const Corners& corners) {
    const glm::vec3 c = (corners[0] - grid.origin) / grid.cell_size;
    return glm::all(glm::lessThan(glm::abs(c - glm::round(c)), glm::vec3(1e-4f)));
  });
  std::map<std::uint32_t, double> expected;  // by key
  std::set<std::uint32_t> unsure;
  for (const Corners& corners : test.triangles) {
    const Triangle64 t = in_cells(grid, corners);
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const glm::ivec3 low = glm::ivec3(glm::floor(glm::min(glm::min(t[0], t[1]), t[2])));
    const glm::ivec3 high = glm::ivec3(glm::floor(glm::max(glm::max(t[0], t[1]), t[2])));
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
          const glm::dvec3 corner(x, y, z);
          const auto piece = clip_to_unit_cube({t[0] - corner, t[1] - corner, t[2] - corner});
          const double area = polygon_area(piece);
          if (area == 0.0) continue;
          const auto key = [&](int step) {
            glm::ivec3 cell(x, y, z);
            cell[axis] += step;
            return static_cast<std::uint32_t>(8 * ((cell.z * 16 + cell.y) * 16 + cell.x) + 2 * axis);
          };
          for (const std::uint32_t back : {0u, 1u}) expected[key(0) + back] += area;
          // What is all near the wall to the next cell may belong there.
          const auto is_near = [&](double wall) {
            return std::all_of(piece.begin(), piece.end(),
                               [&](const glm::dvec3& p) { return std::abs(p[axis] - wall) < 1e-2; });
          };
          for (const int step : {-1, 1})
            if (is_near(step < 0 ? 0.0 : 1.0))
              for (const std::uint32_t back : {0u, 1u}) unsure.insert({key(0) + back, key(step) + back});
        }
  }
  VoxelFaceMemory memory;
  const FrameFaces shown = show(test, kUnit, {.levels = {.resolution = 16}, .areas = true}, memory);
  int seen = 0;
  for (std::size_t slot = 0; slot < shown.keys.size(); ++slot) {
    if (unsure.contains(shown.keys[slot])) continue;
    const auto found = expected.find(shown.keys[slot]);
    const double area = found == expected.end() ? 0.0 : found->second;
    EXPECT_NEAR(shown.areas[slot] / kUnits, area, 1e-3 + 1e-3 * area) << "key " << shown.keys[slot];
    seen += area > 0.1 ? 1 : 0;
  }
  EXPECT_GT(seen, 500);
}

// A closed box whose walls lie between cells: what looks in belongs to the cells inside, what looks out to those round
// it, and nothing is left for the others.
TEST_F(VoxelFacesTest, ABoxHasAllOfItsWalls) {
  const VoxelGrid grid = fit_voxel_grid(kUnit, 16);
  TestTriangles test;
  const auto at = [&](float x, float y, float z) { return grid.origin + grid.cell_size * glm::vec3(x, y, z); };
  for (int axis = 0; axis < 3; ++axis) {
    for (const float depth : {4.0f, 10.0f}) {
      const auto corner = [&](float u, float v) {
        glm::vec3 p(depth);
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        return at(p.x, p.y, p.z);
      };
      test.triangles.push_back({corner(4, 4), corner(10, 4), corner(10, 10)});
      test.triangles.push_back({corner(4, 4), corner(10, 10), corner(4, 10)});
    }
  }
  VoxelFaceMemory memory;
  const FrameFaces shown = show(test, kUnit, {.levels = {.resolution = 16}, .areas = true}, memory);
  EXPECT_NEAR(sum_areas(shown), 2 * 6 * 36, 0.01);
  int full = 0;
  for (std::size_t slot = 0; slot < shown.keys.size(); ++slot) {
    const double area = shown.areas[slot] / kUnits;
    const bool is_full = std::abs(area - 1.0) < 1e-4;
    EXPECT_TRUE(is_full || area < 1e-4) << area;
    full += is_full ? 1 : 0;
  }
  EXPECT_EQ(full, 2 * 6 * 36);
}

// A floor that reaches far beyond the grid, and triangles beyond what numbers can tell.
TEST_F(VoxelFacesTest, AreasOfHugeTriangles) {
  for (const float side : {1e2f, 1e12f, 1e30f}) {
    const std::vector<Corners> floor{
        {glm::vec3(-side, 0.4f, -side), glm::vec3(-side, 0.4f, side), glm::vec3(2 * side, 0.4f, -side)}};
    VoxelFaceMemory memory;
    const FrameFaces shown = show({.triangles = floor}, kUnit, {.levels = {.resolution = 16}, .areas = true}, memory);
    for (const std::uint32_t area : shown.areas) {
      EXPECT_LT(area / kUnits, 1.001) << side;
      if (side < 1e3f) {
        EXPECT_NEAR(area / kUnits, 1.0, 1e-3);
      }
    }
  }
}

// Thousands of pieces too small for one unit each, and more surface than the sums can tell.
TEST_F(VoxelFacesTest, AreasOfVeryManyPieces) {
  const VoxelGrid grid = fit_voxel_grid(kUnit, 4);
  const auto at = [&](glm::vec3 p) { return grid.origin + grid.cell_size * p; };
  TestTriangles dust;
  double expected = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 first(1.1f + 0.8f * static_cast<float>(i % 200) / 200.0f, 1.5f,
                          1.1f + 0.8f * static_cast<float>(i / 200) / 100.0f);
    const float side = 1e-3f;
    dust.triangles.push_back({at(first), at(first + glm::vec3(0, 0, side)), at(first + glm::vec3(0.7f * side, 0, 0))});
    const Triangle64 t = in_cells(grid, dust.triangles.back());
    expected += 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
  }
  VoxelFaceMemory memory;
  const FrameFaces shown = show(dust, kUnit, {.levels = {.resolution = 4}, .areas = true}, memory);
  ASSERT_EQ(shown.areas.size(), 2u);
  for (const std::uint32_t area : shown.areas) EXPECT_NEAR(area / kUnits, expected, 0.03 * expected);

  TestTriangles heap;
  for (int i = 0; i < 9000; ++i) heap.triangles.push_back({at({1, 1.5f, 1}), at({1, 1.5f, 2}), at({2, 1.5f, 1})});
  heap.moving_first = 1000;
  heap.revisions.static_geometry = 1;
  for (const std::uint32_t moving : {0u, 500u, 7999u}) {
    heap.moving_count = moving;
    ++heap.revisions.static_geometry;
    const FrameFaces full = show(heap, kUnit, {.levels = {.resolution = 4}, .areas = true}, memory);
    EXPECT_EQ(std::count(full.areas.begin(), full.areas.end(), 0xffffffffu), 2);
  }
}

}  // namespace
}  // namespace lightwell
