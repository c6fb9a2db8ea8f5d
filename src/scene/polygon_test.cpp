// Triangles of polygons cover what the polygons cover.
#include "scene/polygon.h"

#include <cmath>
#include <iostream>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace lightwell {
namespace {

// Areas of the triangles' own, in the polygon's direction: those that overlap count twice, those turned round less.
struct Cover {
  double area = 0.0;          // sum of signed areas
  double sum_of_sizes = 0.0;  // of their absolute values
  std::size_t count = 0;
};

Cover cover(const std::vector<glm::vec3>& corners) {
  std::vector<std::uint32_t> triangles;
  Triangulator triangulator;
  triangulator.triangulate(corners, triangles);
  EXPECT_EQ(triangulator.unfinished(), 0u);
  const glm::dvec3 normal = glm::normalize(polygon_area_vector(corners));
  Cover result;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const glm::dvec3 a(corners[triangles[i]]), b(corners[triangles[i + 1]]), c(corners[triangles[i + 2]]);
    const double area = 0.5 * glm::dot(glm::cross(b - a, c - a), normal);
    result.area += area;
    result.sum_of_sizes += std::abs(area);
    ++result.count;
  }
  return result;
}

void expect_covered(const std::vector<glm::vec3>& corners, double tolerance = 1e-6) {
  const double area = 0.5 * glm::length(polygon_area_vector(corners));
  const Cover found = cover(corners);
  EXPECT_EQ(found.count, corners.size() - 2);
  EXPECT_NEAR(found.area, area, tolerance * area);
  EXPECT_NEAR(found.sum_of_sizes, area, tolerance * area);
}

TEST(Triangulator, ConvexPolygonsAreFans) {
  std::vector<std::uint32_t> triangles;
  Triangulator().triangulate(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, triangles);
  EXPECT_EQ(triangles, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(Triangulator, ConcavePolygonsAreCoveredOnce) {
  expect_covered({{0, 0, 0}, {1, 0.5f, 0}, {2, 0, 0}, {1, 2, 0}});  // arrow head
  expect_covered(
      {{0, 0, 0}, {3, 0, 0}, {3, 0, 3}, {2, 0, 3}, {2, 0, 1}, {1, 0, 1}, {1, 0, 3}, {0, 0, 3}});  // U, upright
  expect_covered({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}});             // straight corner
  // A hole, joined to the outline by an edge there and back.
  expect_covered(
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}});
}

TEST(Triangulator, StarsInAnyDirection) {
  constexpr unsigned kSeed = 3;
  std::cout << "seed " << kSeed << "\n";
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  for (int round = 0; round < 300; ++round) {
    const glm::vec3 a = glm::normalize(glm::vec3(uniform(random), uniform(random), 1.1f + uniform(random)));
    const glm::vec3 b = glm::normalize(glm::cross(a, glm::vec3(1, 0.1f, 0.2f)));
    const glm::vec3 center(10 * uniform(random), 10 * uniform(random), uniform(random));
    const int count = 5 + round % 60;
    std::vector<glm::vec3> corners;
    for (int i = 0; i < count; ++i) {
      const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(count);
      const float radius = 1.2f + uniform(random);
      corners.push_back(center + radius * (std::cos(angle) * a + std::sin(angle) * b));
    }
    expect_covered(corners, 1e-4);
  }
}

TEST(Triangulator, BentPolygonsHaveAllTheirTriangles) {
  EXPECT_EQ(cover({{0, 0, 0}, {1, 0.5f, 0.3f}, {2, 0, 0}, {1, 2, -0.2f}, {0.5f, 1.5f, 0.1f}}).count, 3u);
}

// Crossing, folded, without area, with one point many times: some triangles, and an end.
TEST(Triangulator, NonsenseEnds) {
  std::vector<std::uint32_t> triangles;
  Triangulator triangulator;
  triangulator.triangulate(std::vector<glm::vec3>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1.5f, 0}}, triangles);
  triangulator.triangulate(std::vector<glm::vec3>(1000, glm::vec3(1)), triangles);
  triangulator.triangulate(std::vector<glm::vec3>{{1e38f, 0, 0}, {-1e38f, 1e38f, 0}, {0, 1, 0}, {3, 0, 1e38f}},
                           triangles);
  triangulator.triangulate(std::vector<glm::vec3>{{0, 0, 0}, {1, 1, 0}}, triangles);
  EXPECT_EQ(triangles.size(), 3u * (2 + 998 + 2));
  std::mt19937 random(5);
  std::vector<glm::vec3> tangle;
  for (int i = 0; i < 20000; ++i)
    tangle.push_back({static_cast<float>(random() % 1000), static_cast<float>(random() % 1000), 0});
  triangles.clear();
  triangulator.triangulate(tangle, triangles);
  EXPECT_EQ(triangles.size(), 3u * (tangle.size() - 2));
  EXPECT_EQ(triangulator.unfinished(), 1u);
}

}  // namespace
}  // namespace lightwell
