// What shadow rays between surfaces lose in empty boxes and leak through walls.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "passes/svo/testing/svo_test_base.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 23;

// From cells of a scene that is turned about the grid's middle.
glm::vec3 to_world(const VoxelGrid& grid, const glm::dmat3& turn, glm::dvec3 cells) {
  const glm::dvec3 middle(0.5 * grid.resolution.x);
  return glm::vec3(glm::dvec3(grid.origin) + (middle + turn * (cells - middle)) * double{grid.cell_size});
}

// A box of two triangles a side.
void add_box(std::vector<Corners>& triangles, const VoxelGrid& grid, glm::dvec3 low, glm::dvec3 high,
             const glm::dmat3& turn = glm::dmat3(1.0)) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool top : {false, true}) {
      const auto corner = [&](bool u, bool v) {
        glm::dvec3 p = low;
        p[axis] = top ? high[axis] : low[axis];
        if (u) p[(axis + 1) % 3] = high[(axis + 1) % 3];
        if (v) p[(axis + 2) % 3] = high[(axis + 2) % 3];
        return to_world(grid, turn, p);
      };
      triangles.push_back({corner(false, false), corner(true, false), corner(true, true)});
      triangles.push_back({corner(false, false), corner(true, true), corner(false, true)});
    }
  }
}

struct BoxPoint {
  glm::dvec3 position, normal;  // inwards
};

BoxPoint random_on_box(std::mt19937& random, glm::dvec3 low, glm::dvec3 high) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const glm::dvec3 size = high - low;
  const glm::dvec3 areas(size.y * size.z, size.z * size.x, size.x * size.y);
  const double pick = uniform(random) * (areas.x + areas.y + areas.z);
  const int axis = pick < areas.x ? 0 : pick < areas.x + areas.y ? 1 : 2;
  BoxPoint p{low + size * glm::dvec3(uniform(random), uniform(random), uniform(random)), glm::dvec3(0.0)};
  const bool top = uniform(random) < 0.5;
  p.position[axis] = top ? high[axis] : low[axis];
  p.normal[axis] = top ? -1.0 : 1.0;
  return p;
}

glm::dvec3 cosine_direction(std::mt19937& random, glm::dvec3 normal) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double z = 1.0 - 2.0 * uniform(random), phi = 2.0 * std::numbers::pi * uniform(random);
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return normal + glm::dvec3(r * std::cos(phi), r * std::sin(phi), z);
}

// Where a ray that starts inside meets the box.
BoxPoint exit_of_box(glm::dvec3 from, glm::dvec3 direction, glm::dvec3 low, glm::dvec3 high) {
  double t = 1e300;
  BoxPoint p{from, glm::dvec3(0.0)};
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const bool up = direction[axis] > 0.0;
    const double exit = ((up ? high[axis] : low[axis]) - from[axis]) / direction[axis];
    if (exit >= t || exit <= 1e-9) continue;
    t = exit;
    p.normal = glm::dvec3(0.0);
    p.normal[axis] = up ? -1.0 : 1.0;
  }
  p.position = from + t * direction;
  return p;
}

glsl::SvoRay surface_ray(const VoxelGrid& grid, const glm::dmat3& turn, const BoxPoint& from, const BoxPoint& to) {
  return {glm::vec4(to_world(grid, turn, from.position), 0.0f), glm::vec4(turn * from.normal, 0.0f),
          glm::vec4(to_world(grid, turn, to.position), 0.0f), glm::vec4(turn * to.normal, 0.0f)};
}

// Where walls lie in their cells: on borders, just beside them, inside.
constexpr double kOffsets[] = {0.0, 1e-6, 0.02, 0.25, 0.5, 0.75, 0.98, 1.0 - 1e-6};

class SurfaceRaysTest : public SvoTest {
 protected:
  // Of the light that is exchanged between the walls of an empty box over more than 2 cells: cosine-distributed rays
  // from points spread evenly carry equal parts.
  double visible_in_box(std::uint32_t resolution, double low_offset, double high_offset, const SvoSettings& settings,
                        std::uint32_t way, const glm::dmat3& turn = glm::dmat3(1.0)) {
    constexpr std::size_t kRays = 20000;
    const VoxelGrid grid = fit_voxel_grid(kUnit, resolution);
    // Turned ones are smaller, so that they fit.
    const double margin = turn == glm::dmat3(1.0) ? 2.0 : 0.25 * resolution;
    const glm::dvec3 low(margin + low_offset), high(resolution - margin - 1.0 + high_offset);
    std::vector<Corners> triangles;
    add_box(triangles, grid, low, high, turn);
    std::mt19937 random(kSeed);
    std::vector<glsl::SvoRay> rays;
    while (rays.size() < kRays) {
      const BoxPoint from = random_on_box(random, low, high);
      const BoxPoint to = exit_of_box(from.position, cosine_direction(random, from.normal), low, high);
      if (glm::length(to.position - from.position) > 2.0) rays.push_back(surface_ray(grid, turn, from, to));
    }
    const std::vector<std::uint32_t> blocked = trace(triangles, settings, rays, way);
    return 1.0 - static_cast<double>(std::count(blocked.begin(), blocked.end(), 1u)) / kRays;
  }

  // Two rooms and a wall between them, `thickness` in cells: the part of the light that reaches surfaces of one from
  // those of the other, of what would without the wall.
  double leak(std::uint32_t resolution, double offset, double thickness, const SvoSettings& settings,
              std::uint32_t way) {
    constexpr std::size_t kRays = 20000;
    const VoxelGrid grid = fit_voxel_grid(kUnit, resolution);
    const glm::dvec3 low(2.0 + offset), high(resolution - 3.0 + offset);
    glm::dvec3 wall_low = low, wall_high = high;
    wall_low.x = 0.5 * resolution + offset;
    wall_high.x = wall_low.x + thickness;
    std::vector<Corners> triangles;
    add_box(triangles, grid, low, high);
    add_box(triangles, grid, wall_low, wall_high);
    std::mt19937 random(kSeed);
    std::vector<glsl::SvoRay> rays;
    while (rays.size() < kRays) {
      const BoxPoint from = random_on_box(random, low, high);
      const BoxPoint to = exit_of_box(from.position, cosine_direction(random, from.normal), low, high);
      const double a = std::min(from.position.x, to.position.x), b = std::max(from.position.x, to.position.x);
      if (a < wall_low.x && b > wall_high.x) rays.push_back(surface_ray(grid, glm::dmat3(1.0), from, to));
    }
    const std::vector<std::uint32_t> blocked = trace(triangles, settings, rays, way);
    return 1.0 - static_cast<double>(std::count(blocked.begin(), blocked.end(), 1u)) / kRays;
  }
};

TEST_F(SurfaceRaysTest, AnEmptyBoxIsEmpty) {
  for (const std::uint32_t resolution : {64u, 128u})
    for (const double low : kOffsets)
      for (const double high : {low, 1.0 - low, 0.5})
        EXPECT_GE(
            visible_in_box(resolution, low, high, {.resolution = resolution, .tree = false}, glsl::kVoxelsBetween),
            0.99)
            << resolution << ": " << low << " " << high << ", seed " << kSeed;
}

// Walls that lie in all levels, whose cells double towards the other end of the box.
TEST_F(SurfaceRaysTest, AnEmptyBoxOfLevelsIsEmpty) {
  const float coarsest = fit_voxel_grid(kUnit, 64).cell_size;
  for (const glm::vec3& focus : {glm::vec3(0.5f), glm::vec3(0.05f), glm::vec3(0.1f, 0.6f, 0.3f)}) {
    for (const double offset : kOffsets) {
      const SvoSettings settings{.resolution = 64, .tree = false, .finest_cell = 0.13f * coarsest, .focus = focus};
      const double visible = visible_in_box(64, offset, 1.0 - offset, settings, glsl::kVoxelsBetween);
      EXPECT_GE(visible, 0.99) << "offset " << offset << ", seed " << kSeed;
    }
  }
}

TEST_F(SurfaceRaysTest, AWallOfTwoCoarsestCellsIsClosedAtAllLevels) {
  const float coarsest = fit_voxel_grid(kUnit, 64).cell_size;
  for (const double offset : kOffsets) {
    const SvoSettings settings{
        .resolution = 64, .tree = false, .finest_cell = 0.13f * coarsest, .focus = glm::vec3(0.5f, 0.3f, 0.5f)};
    EXPECT_LE(leak(64, offset, 2.0, settings, glsl::kVoxelsBetween), 0.001) << offset << ", seed " << kSeed;
  }
}

TEST_F(SurfaceRaysTest, AWallOfTwoCellsIsTight) {
  for (const std::uint32_t resolution : {64u, 128u})
    for (const double offset : kOffsets)
      EXPECT_LE(leak(resolution, offset, 2.0, {.resolution = resolution, .tree = false}, glsl::kVoxelsBetween), 0.01)
          << resolution << ": " << offset << ", seed " << kSeed;
}

// About all three axes.
const glm::dmat3 kTurned(glm::rotate(glm::dmat4(1.0), 0.6, glm::normalize(glm::dvec3(1.0, 2.0, -0.7))));

// Its walls fill cells in steps, out of which some rays do not come. The box has half as many cells a side.
TEST_F(SurfaceRaysTest, ATurnedBoxIsNearlyEmpty) {
  for (const std::uint32_t resolution : {64u, 128u})
    EXPECT_GE(
        visible_in_box(resolution, 0.3, 0.1, {.resolution = resolution, .tree = false}, glsl::kVoxelsBetween, kTurned),
        resolution == 64 ? 0.92 : 0.95)
        << resolution << ", seed " << kSeed;
}

class DISABLED_SvoTable : public SurfaceRaysTest {};

// Not part of the run:
//   lightwell_passes_test --gtest_also_run_disabled_tests --gtest_filter='*SvoTable.*'
// The published traversal over its epsilon, beside ours: walls in the middle of cells, the worst of kOffsets, a turned
// box; a wall of two cells, and one without thickness.
TEST_F(DISABLED_SvoTable, LossAndLeak) {
  const auto print = [&](const char* name, SvoSettings settings, std::uint32_t way) {
    for (const std::uint32_t resolution : {64u, 128u}) {
      settings.resolution = resolution;
      double least = 1.0, most = 0.0;
      for (const double offset : kOffsets) {
        least = std::min(least, visible_in_box(resolution, offset, 1.0 - offset, settings, way));
        most = std::max(most, leak(resolution, offset, 2.0, settings, way));
      }
      std::printf(
          "%-24s %4u^3: visible %.4f mid-cell, %.4f worst, %.4f turned; leak %.4f mid-cell, %.4f worst, %.4f plane\n",
          name, resolution, visible_in_box(resolution, 0.5, 0.5, settings, way), least,
          visible_in_box(resolution, 0.3, 0.1, settings, way, kTurned), leak(resolution, 0.5, 2.0, settings, way), most,
          leak(resolution, 0.5, 0.0, settings, way));
    }
  };
  for (const float epsilon : {0.5f, 1.0f, 1.8f, 3.0f, 5.0f, 8.0f})
    print(("restart, epsilon " + std::to_string(epsilon).substr(0, 3)).c_str(), {.epsilon = epsilon},
          glsl::kSvoRestart);
  print("voxels between surfaces", {}, glsl::kVoxelsBetween);
}

}  // namespace
}  // namespace lightwell
