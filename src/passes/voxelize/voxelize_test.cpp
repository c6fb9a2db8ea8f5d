// Voxelisation against a triangle-box test on the CPU in double precision (testing/triangle_oracle.h).
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
#include "passes/voxelize/testing/triangle_oracle.h"

namespace lightwell {
namespace {

class VoxelizeTest : public GraphTest {
 protected:
  // The scene's words, one a cell.
  std::vector<std::uint32_t> voxelize(const VoxelGrid& grid, const std::vector<Corners>& triangles,
                                      std::uint32_t tile_capacity) {
    const auto count = static_cast<std::uint32_t>(triangles.size());
    return voxelize(grid, triangles, {count, count, 0}, tile_capacity);
  }
  // Of some of them.
  std::vector<std::uint32_t> voxelize(const VoxelGrid& grid, const std::vector<Corners>& triangles,
                                      const glsl::TriangleChoice& choice, std::uint32_t tile_capacity) {
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
    const ReadbackTicket ticket = graph.read_back(record_voxelize(graph, scene, choice, grid, tile_capacity).cells);
    run(graph);
    return fetch<std::uint32_t>(ticket);
  }

  void expect_exact(const VoxelGrid& grid, const std::vector<Corners>& triangles,
                    const std::vector<std::uint32_t>& cells) {
    const CellOracle oracle = ask_oracle(grid, triangles);
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

TEST_F(VoxelizeTest, SomeTrianglesFillWhatTheyFillAlone) {
  const VoxelGrid grid = fit_voxel_grid({glm::vec3(0.0f), glm::vec3(1.0f)}, 32);
  const std::vector<Corners> triangles = random_triangles(grid, 7, 100);
  GpuScene::Frame scene;
  scene.triangle_count = 100;
  for (const auto& [first, count] :
       {std::pair{0u, 30u}, std::pair{40u, 25u}, std::pair{90u, 10u}, std::pair{0u, 100u}}) {
    scene.moving_first = first;
    scene.moving_count = count;
    const auto end = triangles.begin() + first + count;
    const std::vector<Corners> moving(triangles.begin() + first, end);
    std::vector<Corners> standing(triangles.begin(), triangles.begin() + first);
    standing.insert(standing.end(), end, triangles.end());
    for (const std::uint32_t tile_capacity : {5u, 1u << 19}) {
      EXPECT_EQ(voxelize(grid, triangles, moving_triangles(scene), tile_capacity),
                voxelize(grid, moving, tile_capacity));
      if (standing.empty()) continue;
      EXPECT_EQ(voxelize(grid, triangles, standing_triangles(scene), tile_capacity),
                voxelize(grid, standing, tile_capacity));
    }
  }
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
