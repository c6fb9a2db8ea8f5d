// Points on surfaces and the faces that are found for them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>

#include <glm/geometric.hpp>

#include "passes/voxel_faces/testing/faces_test_base.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 29;

class Random {
 public:
  float uniform() { return distribution_(engine_); }
  glm::vec3 vector() { return {uniform(), uniform(), uniform()}; }

 private:
  std::mt19937 engine_{kSeed};
  std::uniform_real_distribution<float> distribution_{0.0f, 1.0f};
};

// Planes at 45 degrees to two axes or to all of them, and in the walls between cells, each turned either way.
std::vector<Corners> special_triangles(const VoxelGrid& grid, Random& random, int count) {
  const float side = static_cast<float>(grid.resolution.x) * grid.cell_size;
  std::vector<Corners> triangles;
  for (int i = 0; i < count; ++i) {
    const float size = side * std::pow(2.0f, -6.0f * random.uniform());
    const glm::vec3 first = grid.origin + side * random.vector();
    const int axis = i % 3;
    const glm::vec3 u = size * (random.vector() - 0.5f);
    const glm::vec3 v = size * (random.vector() - 0.5f);
    Corners corners{first, first + u, first + v};
    for (glm::vec3& corner : corners) {
      const glm::vec3 offset = corner - first;
      const float s = i % 2 == 0 ? 1.0f : -1.0f;
      float& depth = corner[axis];
      if (i % 12 < 4) depth = first[axis] + s * offset[(axis + 1) % 3];
      if (i % 12 >= 4 && i % 12 < 8) depth = first[axis] + s * offset[(axis + 1) % 3] - offset[(axis + 2) % 3];
      if (i % 12 >= 8) {
        const float wall = std::round((first[axis] - grid.origin[axis]) / grid.cell_size);
        depth = grid.origin[axis] + grid.cell_size * wall;
      }
    }
    triangles.push_back(corners);
  }
  return triangles;
}

// Whether it is so wide that single precision can tell its normal. Hardly a ray meets others.
bool has_normal(const Corners& t, const glm::vec3& normal) {
  float longest = 0.0f, farthest = 0.0f;
  for (std::size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, glm::distance(t[i], t[(i + 1) % 3]));
    farthest = std::max(farthest, glm::length(t[i]));
  }
  return glm::length(normal) > 1e-5f * farthest * longest;
}

// Points of the triangles inside the grid as rays find them: with the rounding of origin + distance * direction.
std::vector<glsl::SurfacePoint> hit_points(const VoxelGrid& grid, const std::vector<Corners>& triangles, Random& random,
                                           int each) {
  std::vector<glsl::SurfacePoint> points;
  const glm::vec3 upper = upper_corner(grid);
  for (const Corners& t : triangles) {
    const glm::vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    if (!has_normal(t, normal)) continue;
    for (int i = 0; i < each; ++i) {
      const float a = std::sqrt(random.uniform());
      const float b = random.uniform();
      const glm::vec3 target = (1.0f - a) * t[0] + a * (1.0f - b) * t[1] + a * b * t[2];
      const glm::vec3 origin = grid.origin + (upper - grid.origin) * random.vector();
      const float distance = glm::distance(origin, target);
      const glm::vec3 hit = origin + distance * ((target - origin) / distance);
      if (glm::any(glm::lessThan(hit, grid.origin)) || glm::any(glm::greaterThan(hit, upper))) continue;
      points.push_back({glm::vec4(hit, 0.0f), glm::vec4(glm::normalize(normal) * (i % 2 == 0 ? 1.0f : -1.0f), 0.0f)});
    }
  }
  return points;
}

// A face of the point's cell, or of one that it nearly touches, in a direction of the normal.
bool is_right(const FrameFaces& shown, const glsl::SurfacePoint& point, std::uint32_t slot) {
  if (slot >= shown.keys.size()) return false;
  const VoxelGrid grid = level_grid(shown.faces.levels, 0);
  const std::uint32_t cell = shown.keys[slot] / 8;
  const glm::uvec3 r = grid.resolution;
  const glm::vec3 corner(glm::uvec3(cell % r.x, cell / r.x % r.y, cell / (r.x * r.y)));
  const glm::vec3 local = (glm::vec3(point.position) - grid.origin) / grid.cell_size - corner;
  if (glm::any(glm::lessThan(local, glm::vec3(-2e-3f))) || glm::any(glm::greaterThan(local, glm::vec3(1.002f))))
    return false;
  const std::uint32_t direction = shown.keys[slot] % 8;
  const glm::vec3 normal(point.normal);
  const glm::vec3 size = glm::abs(normal);
  const float component = normal[static_cast<int>(direction / 2)] * (direction % 2 == 0 ? 1.0f : -1.0f);
  return component > 0.75f * std::max({size.x, size.y, size.z});
}

std::size_t count_wrong(const FrameFaces& shown, const std::vector<glsl::SurfacePoint>& points) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) wrong += is_right(shown, points[i], shown.slots[i]) ? 0 : 1;
  return wrong;
}

TEST_F(VoxelFacesTest, EveryHitFindsItsFace) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Random random;
  for (const std::uint32_t resolution : {16u, 64u, 128u}) {
    for (const glm::vec3 corner : {glm::vec3(0.0f), glm::vec3(-37.0f, 5.0f, 20.0f)}) {
      const Bounds bounds{corner, corner + glm::vec3(4.0f, 3.0f, 5.0f)};
      const VoxelGrid grid = fit_voxel_grid(bounds, resolution);
      for (const bool special : {false, true}) {
        const std::vector<Corners> triangles =
            special ? special_triangles(grid, random, 1000) : random_triangles(grid, kSeed, 1000);
        const std::vector<glsl::SurfacePoint> points = hit_points(grid, triangles, random, 40);
        VoxelFaceMemory memory;
        const FrameFaces shown =
            show({.triangles = triangles}, bounds, {.levels = {.resolution = resolution}}, memory, "test: ", points);
        ASSERT_EQ(shown.keys.size(), shown.found);
        EXPECT_LE(static_cast<double>(count_wrong(shown, points)), 1e-4 * static_cast<double>(points.size()))
            << "resolution " << resolution << (special ? ", special" : ", random") << " of " << points.size();
        EXPECT_GT(points.size(), 15000u);
      }
    }
  }
}

// Points of the scene's surfaces, as many in a square metre everywhere.
TEST_F(VoxelFacesTest, EveryPointOfSponzaFindsItsFace) {
  const std::string path = LIGHTWELL_SHARED_DIR "/scenes/sponza-crytek/sponza-crytek.gltf";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const Scene scene = load_scene(path, {.scale = 0.01f});
  const SceneSnapshot snapshot = take_snapshot(scene);
  GpuScene gpu_scene(device(), scene, snapshot);
  std::vector<Corners> triangles;
  {
    FrameGraph graph(executor().context());
    const GpuScene::Frame frame = gpu_scene.record(graph, snapshot);
    const ReadbackTicket vertex_ticket = graph.read_back(frame.vertices);
    const ReadbackTicket index_ticket = graph.read_back(frame.indices);
    run(graph);
    const auto vertices = fetch<glsl::WorldVertex>(vertex_ticket);
    const auto indices = fetch<std::uint32_t>(index_ticket);
    triangles.resize(frame.triangle_count);
    for (std::size_t i = 0; i < 3 * triangles.size(); ++i)
      triangles[i / 3][i % 3] = glm::vec3(vertices[indices[i]].position_material);
  }
  std::vector<float> areas;
  for (const Corners& t : triangles) areas.push_back(glm::length(glm::cross(t[1] - t[0], t[2] - t[0])));
  std::mt19937 engine(kSeed);
  std::discrete_distribution<std::size_t> by_area(areas.begin(), areas.end());
  std::vector<Corners> chosen;
  for (int i = 0; i < 20000; ++i) chosen.push_back(triangles[by_area(engine)]);

  Random random;
  for (const std::uint32_t resolution : {64u, 128u}) {
    const VoxelGrid grid = fit_voxel_grid(snapshot.bounds, resolution);
    const std::vector<glsl::SurfacePoint> points = hit_points(grid, chosen, random, 10);
    VoxelFaceMemory memory;
    const FrameFaces shown =
        show_scene(snapshot.bounds, {.levels = {.resolution = resolution}}, memory, "test: ", points,
                   [&](FrameGraph& graph) { return gpu_scene.record(graph, snapshot); });
    expect_faces_of_cells(shown);
    std::printf("sponza-crytek %u^3: %u faces, room for %u\n", resolution, shown.found, shown.faces.capacity);
    EXPECT_LE(static_cast<double>(count_wrong(shown, points)), 1e-4 * static_cast<double>(points.size()));
    EXPECT_GT(points.size(), 190000u);
  }
}

// However the points of a surface between two cells are rounded: the side that looks up is a face of the upper cell,
// the other one of the lower.
TEST_F(VoxelFacesTest, ASideOfAWallBetweenCellsIsOneFace) {
  Random random;
  constexpr std::uint32_t kResolution = 32;
  const VoxelGrid grid = fit_voxel_grid(kUnit, kResolution);
  for (int axis = 0; axis < 3; ++axis) {
    const float depth = grid.origin[axis] + 7.0f * grid.cell_size;
    const auto on_wall = [&](float u, float v) {
      glm::vec3 p(0.0f);
      p[axis] = depth;
      p[(axis + 1) % 3] = u;
      p[(axis + 2) % 3] = v;
      return p;
    };
    const std::vector<Corners> wall{{on_wall(0.0f, 0.0f), on_wall(1.0f, 0.0f), on_wall(1.0f, 1.0f)},
                                    {on_wall(0.0f, 0.0f), on_wall(1.0f, 1.0f), on_wall(0.0f, 1.0f)}};
    std::vector<glsl::SurfacePoint> points;
    for (int i = 0; i < 4000; ++i) {
      glm::vec3 p = on_wall(random.uniform(), random.uniform());
      p[axis] += grid.cell_size * 4e-5f * (random.uniform() - 0.5f);
      glm::vec3 normal(0.0f);
      normal[axis] = i % 2 == 0 ? 1.0f : -1.0f;
      points.push_back({glm::vec4(p, 0.0f), glm::vec4(normal, 0.0f)});
    }
    VoxelFaceMemory memory;
    const FrameFaces shown =
        show({.triangles = wall}, kUnit, {.levels = {.resolution = kResolution}}, memory, "test: ", points);
    const std::uint32_t stride[3] = {1, kResolution, kResolution * kResolution};
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_TRUE(is_right(shown, points[i], shown.slots[i])) << i;
      ASSERT_EQ(shown.keys[shown.slots[i]] / 8 / stride[axis] % kResolution, i % 2 == 0 ? 7u : 6u) << i;
    }
  }
}

TEST_F(VoxelFacesTest, WhereNothingIsNoFaceIsFound) {
  VoxelFaceMemory memory;
  const TestTriangles floor{.triangles = {{glm::vec3(0.0f), glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(1.0f, 0.0f, 0.0f)}}};
  const auto point = [](glm::vec3 p, glm::vec3 n) {
    return glsl::SurfacePoint{glm::vec4(p, 0.0f), glm::vec4(n, 0.0f)};
  };
  const glm::vec3 up(0.0f, 1.0f, 0.0f);
  const std::vector<glsl::SurfacePoint> points{
      point({0.2f, 0.0f, 0.2f}, up),        point({0.2f, 0.0f, 0.2f}, -up),
      point({0.2f, 0.5f, 0.2f}, up),        point({0.9f, 0.0f, 0.9f}, up),
      point({0.2f, -3.0f, 0.2f}, up),       point({0.2f, 0.0f, 1e30f}, up),
      point({0.2f, 0.0f, 0.2f}, {1, 0, 0}), point({0.2f, 0.0f, 0.2f}, glm::vec3(0.0f)),
  };
  const FrameFaces shown = show(floor, kUnit, {.levels = {.resolution = 16}}, memory, "test: ", points);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(shown.slots[i] == glsl::kNoFace, i >= 2) << i;
}

}  // namespace
}  // namespace lightwell
