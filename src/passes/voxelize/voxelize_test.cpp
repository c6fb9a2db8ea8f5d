// Voxelisation against a triangle-box test on the CPU in double precision: a cell is filled if a triangle meets the
// cell shrunk by 1e-4 of its side, and empty if all miss the cell grown by as much.
#include "passes/voxelize/voxelize.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <filesystem>
#include <random>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "gpu/submit.h"
#include "graph/executor.h"
#include "graph/testing/graph_test.h"
#include "passes/gpu_scene/gpu_scene_types.h"

namespace lightwell {
namespace {

using Corners = std::array<glm::vec3, 3>;

// Separating axes, written from the definition: all 13 axes, all corners of the box.
bool meets_box(const std::array<glm::dvec3, 3>& triangle, glm::dvec3 center, double half_side) {
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

struct Oracle {
  std::vector<bool> must_fill;
  std::vector<bool> may_fill;
};

Oracle ask_oracle(const VoxelGrid& grid, const std::vector<Corners>& triangles) {
  Oracle oracle{std::vector<bool>(grid.cell_count), std::vector<bool>(grid.cell_count)};
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

class VoxelizeTest : public GraphTest {
 protected:
  // The scene's words, one a cell.
  std::vector<std::uint32_t> voxelize(const VoxelGrid& grid, const std::vector<Corners>& triangles,
                                      std::uint32_t tile_capacity) {
    std::vector<glsl::WorldVertex> vertices;
    for (const Corners& corners : triangles)
      for (const glm::vec3& corner : corners)
        vertices.push_back({glm::vec4(corner, 0.0f), glm::vec4(0.0f), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)});
    std::vector<std::uint32_t> indices(vertices.size());
    for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
    FrameGraph graph(executor().context());
    GpuScene::Frame scene;
    scene.vertices = graph.upload("vertices", std::span<const glsl::WorldVertex>(vertices));
    scene.indices = graph.upload("indices", std::span<const std::uint32_t>(indices));
    scene.triangle_count = static_cast<std::uint32_t>(triangles.size());
    scene.set = create_scene_set(graph, scene);
    const ReadbackTicket ticket = graph.read_back(record_voxelize(graph, scene, grid, tile_capacity).cells);
    run(graph);
    return fetch<std::uint32_t>(ticket);
  }

  void expect_exact(const VoxelGrid& grid, const std::vector<Corners>& triangles,
                    const std::vector<std::uint32_t>& cells) {
    const Oracle oracle = ask_oracle(grid, triangles);
    std::size_t missing = 0;
    std::size_t extra = 0;
    std::size_t filled = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool is_filled = (cells[i] & glsl::kCellOccupied) != 0;
      filled += is_filled ? 1 : 0;
      missing += oracle.must_fill[i] && !is_filled ? 1 : 0;
      extra += !oracle.may_fill[i] && is_filled ? 1 : 0;
    }
    EXPECT_EQ(missing, 0u) << "of " << filled;
    EXPECT_EQ(extra, 0u) << "of " << filled;
    EXPECT_GT(filled, 0u);
  }
};

// Of all sizes from much less than a cell to the whole grid, some outside it; slivers, segments and points; some with
// corners exactly on cell walls.
std::vector<Corners> random_triangles(const VoxelGrid& grid, std::uint32_t seed, int count) {
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

TEST_F(VoxelizeTest, RandomTrianglesFillExactlyTheCellsTheyMeet) {
  for (const std::uint32_t resolution : {32u, 64u, 128u}) {
    for (const glm::vec3 corner : {glm::vec3(0.0f), glm::vec3(-37.0f, 5.0f, 120.0f)}) {
      const VoxelGrid grid = fit_voxel_grid({corner, corner + glm::vec3(4.0f, 3.0f, 5.0f)}, resolution);
      constexpr std::uint32_t kSeed = 11;
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", resolution " + std::to_string(resolution));
      // Few enough that most cells stay empty.
      for (const int count : {40, 400}) {
        const std::vector<Corners> triangles = random_triangles(grid, kSeed + static_cast<std::uint32_t>(count), count);
        expect_exact(grid, triangles, voxelize(grid, triangles, 1u << 19));
      }
    }
  }
}

TEST_F(VoxelizeTest, AnOverflowingListOfTilesLosesNothing) {
  const VoxelGrid grid = fit_voxel_grid({glm::vec3(0.0f), glm::vec3(1.0f)}, 32);
  const std::vector<Corners> triangles = random_triangles(grid, 3, 100);
  EXPECT_EQ(voxelize(grid, triangles, 5), voxelize(grid, triangles, 1u << 19));
}

TEST_F(VoxelizeTest, CellsKnowWhichWayTheirSurfacesFace) {
  const VoxelGrid grid = fit_voxel_grid({glm::vec3(0.0f), glm::vec3(1.0f)}, 8);
  const float y = 0.3f;
  const std::vector<Corners> up{{glm::vec3(0.0f, y, 0.0f), glm::vec3(0.0f, y, 1.0f), glm::vec3(1.0f, y, 0.0f)}};
  for (const std::uint32_t word : voxelize(grid, up, 64)) {
    if (word == 0) continue;
    EXPECT_EQ(word, glsl::kCellOccupied | 1u << 2 | 1u << (glsl::kCellBackShift + 3));
  }
}

class VoxelizeSceneTest : public VoxelizeTest, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(VoxelizeSceneTest, SponzaFillsExactlyTheCellsItMeets) {
  const std::string path = LIGHTWELL_SHARED_DIR "/scenes/sponza-crytek/sponza-crytek.gltf";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const Scene scene = load_scene(path, {.scale = 0.01f});
  const SceneSnapshot snapshot = take_snapshot(scene);
  GpuScene gpu_scene(device(), scene, snapshot);
  const VoxelGrid grid = fit_voxel_grid(snapshot.bounds, GetParam());
  FrameGraph graph(executor().context());
  const GpuScene::Frame frame = gpu_scene.record(graph, snapshot);
  const ReadbackTicket vertex_ticket = graph.read_back(frame.vertices);
  const ReadbackTicket index_ticket = graph.read_back(frame.indices);
  const ReadbackTicket cell_ticket = graph.read_back(record_voxelize(graph, frame, grid).cells);
  run(graph);

  const auto vertices = fetch<glsl::WorldVertex>(vertex_ticket);
  const auto indices = fetch<std::uint32_t>(index_ticket);
  std::vector<Corners> triangles(frame.triangle_count);
  for (std::size_t i = 0; i < 3 * triangles.size(); ++i)
    triangles[i / 3][i % 3] = glm::vec3(vertices[indices[i]].position_material);
  expect_exact(grid, triangles, fetch<std::uint32_t>(cell_ticket));
}

INSTANTIATE_TEST_SUITE_P(Resolutions, VoxelizeSceneTest, ::testing::Values(32u, 64u, 128u));

}  // namespace
}  // namespace lightwell
