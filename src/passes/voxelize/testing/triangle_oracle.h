// Which cells triangles meet, on the CPU in double precision, and triangles of all kinds to ask about.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "passes/voxel_grid/voxel_grid.h"

namespace lightwell {

using Corners = std::array<glm::vec3, 3>;

// Separating axes, written from the definition: all 13 axes, all corners of the box.
inline bool meets_box(const std::array<glm::dvec3, 3>& triangle, glm::dvec3 center, double half_side) {
  const std::array<glm::dvec3, 3> edges{triangle[1] - triangle[0], triangle[2] - triangle[1],
                                        triangle[0] - triangle[2]};
  std::vector<glm::dvec3> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, glm::cross(edges[0], edges[1])};
  for (const glm::dvec3& edge : edges)
    for (int axis = 0; axis < 3; ++axis) axes.push_back(glm::cross(edge, axes[static_cast<std::size_t>(axis)]));
  for (const glm::dvec3& axis : axes) {
    double low = 1e300;
    double high = -1e300;
    for (const glm::dvec3& corner : triangle) {
      low = std::min(low, glm::dot(axis, corner - center));
      high = std::max(high, glm::dot(axis, corner - center));
    }
    const double radius = half_side * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
    if (low > radius || high < -radius) return false;
  }
  return true;
}

// A cell must be filled if a triangle meets it shrunk by 1e-4 of its side; it may be if one meets it grown by as much.
struct CellOracle {
  std::vector<bool> must_fill;
  std::vector<bool> may_fill;
};

inline CellOracle ask_oracle(const VoxelGrid& grid, const std::vector<Corners>& triangles) {
  CellOracle oracle{std::vector<bool>(grid.cell_count), std::vector<bool>(grid.cell_count)};
  const glm::ivec3 last = glm::ivec3(grid.resolution) - 1;
  for (const Corners& corners : triangles) {
    std::array<glm::dvec3, 3> t;
    for (std::size_t i = 0; i < 3; ++i)
      t[i] = (glm::dvec3(corners[i]) - glm::dvec3(grid.origin)) / double{grid.cell_size};
    const glm::dvec3 edge(1e-3);
    const glm::ivec3 low = glm::max(glm::ivec3(glm::floor(glm::min(glm::min(t[0], t[1]), t[2]) - edge)), 0);
    const glm::ivec3 high = glm::min(glm::ivec3(glm::floor(glm::max(glm::max(t[0], t[1]), t[2]) + edge)), last);
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
          const std::size_t cell =
              (static_cast<std::size_t>(z) * grid.resolution.y + static_cast<std::size_t>(y)) * grid.resolution.x +
              static_cast<std::size_t>(x);
          const glm::dvec3 center = glm::dvec3(x, y, z) + 0.5;
          if (!oracle.may_fill[cell] && meets_box(t, center, 0.5 + 1e-4)) oracle.may_fill[cell] = true;
          if (!oracle.must_fill[cell] && meets_box(t, center, 0.5 - 1e-4)) oracle.must_fill[cell] = true;
        }
      }
    }
  }
  return oracle;
}

// Of all sizes from much less than a cell to the whole grid, some outside it; slivers, segments and points; some with
// corners exactly on cell walls.
inline std::vector<Corners> random_triangles(const VoxelGrid& grid, std::uint32_t seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  const auto in_grid = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
  const float side = static_cast<float>(grid.resolution.x) * grid.cell_size;
  std::vector<Corners> triangles;
  for (int i = 0; i < count; ++i) {
    const float size = side * std::pow(2.0f, -10.0f * uniform(random));
    const glm::vec3 first = grid.origin + side * (1.2f * in_grid() - 0.1f);
    Corners corners{first, first + size * (in_grid() - 0.5f), first + size * (in_grid() - 0.5f)};
    if (i % 16 == 1) corners[2] = corners[0];                                      // a segment
    if (i % 16 == 2) corners[1] = corners[2] = corners[0];                         // a point
    if (i % 16 == 3) corners[2] = 0.5f * (corners[0] + corners[1]);                // flat, nearly
    if (i % 16 == 4) corners[2] = corners[0] + 1e-4f * size * (in_grid() - 0.5f);  // a sliver
    if (i % 16 == 5)
      for (glm::vec3& c : corners) c = grid.origin + grid.cell_size * glm::round((c - grid.origin) / grid.cell_size);
    if (i % 16 == 6) corners[1].y = corners[2].y = corners[0].y;  // level
    triangles.push_back(corners);
  }
  return triangles;
}

}  // namespace lightwell
