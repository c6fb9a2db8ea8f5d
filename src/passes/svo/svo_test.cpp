// The octree against one built on the CPU from the same bits, and the bits against triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "passes/svo/testing/svo_test_base.h"
#include "passes/svo/testing/tree_oracle.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 17;

class SvoBuildTest : public SvoTest, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(SvoBuildTest, TheTreeHoldsTheVoxels) {
  for (const SvoVoxels voxels : {SvoVoxels::kRasterised, SvoVoxels::kConservative}) {
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    const VoxelGrid grid = fit_voxel_grid(kUnit, GetParam());
    const BuiltSvo built =
        build(random_triangles(grid, kSeed, 200), kUnit, {.resolution = GetParam(), .voxels = voxels});
    ASSERT_EQ(built.reached(), built.level());
    EXPECT_EQ(1u << built.level(), GetParam());
    EXPECT_GT(built.counts[glsl::kSvoFragments], GetParam());
    expect_tree_of_bits(built);
    expect_coarse_bits(built);
  }
}

TEST_F(SvoTest, TheFinestTreeHoldsTheVoxels) {
  const VoxelGrid grid = fit_voxel_grid(kUnit, 1024);
  const BuiltSvo built =
      build(random_triangles(grid, kSeed, 25), kUnit, {.resolution = 1024, .budget = std::uint64_t{400} << 20});
  EXPECT_EQ(built.reached(), 10u);
  expect_tree_of_bits(built);
  expect_coarse_bits(built);
}

INSTANTIATE_TEST_SUITE_P(Resolutions, SvoBuildTest, ::testing::Values(8u, 16u, 32u, 128u, 256u, 512u));

std::size_t cell_index(const VoxelGrid& grid, glm::uvec3 c) {
  return (std::size_t{c.z} * grid.resolution.y + c.y) * grid.resolution.x + c.x;
}

TEST_F(SvoTest, ConservativeCellsAreThoseThatTrianglesMeet) {
  for (const std::uint32_t resolution : {32u, 64u}) {
    const VoxelGrid grid = fit_voxel_grid(kUnit, resolution);
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    for (const int count : {60, 300}) {
      const std::vector<Corners> triangles = random_triangles(grid, kSeed, count);
      const CellOracle oracle = ask_oracle(grid, triangles);
      const BuiltSvo built = build(triangles, kUnit, {.resolution = resolution});
      for (std::uint32_t cell = 0; cell < grid.cell_count; ++cell) {
        const glm::uvec3 c(cell % resolution, cell / resolution % resolution, cell / resolution / resolution);
        if (built.is_occupied(c)) {
          ASSERT_TRUE(oracle.may_fill[cell_index(grid, c)]) << cell;
        } else {
          ASSERT_FALSE(oracle.must_fill[cell_index(grid, c)]) << cell;
        }
      }
      expect_tree_of_bits(built);
    }
  }
}

// Columns of cells along the triangle's main axis, whose centre lines it meets well inside, at depths well inside a
// cell. Rasterisers may move corners to a grid of sub-pixels.
TEST_F(SvoTest, RasterisedCellsAreThoseUnderPixelCentres) {
  constexpr std::uint32_t kResolution = 64;
  const VoxelGrid grid = fit_voxel_grid(kUnit, kResolution);
  const double snap = 2.0 / std::exp2(device().limits().subPixelPrecisionBits) + 1e-3;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const std::vector<Corners> triangles = random_triangles(grid, kSeed, 200);
  const BuiltSvo built = build(triangles, kUnit, {.resolution = kResolution, .voxels = SvoVoxels::kRasterised});
  expect_tree_of_bits(built);

  std::set<std::uint32_t> must, may;
  for (const Corners& corners : triangles) {
    std::array<glm::dvec3, 3> t;
    for (std::size_t i = 0; i < 3; ++i)
      t[i] = (glm::dvec3(corners[i]) - glm::dvec3(grid.origin)) / double{grid.cell_size};
    const glm::dvec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
    const glm::dvec3 size = glm::abs(n);
    // All axes that rounding may take for the largest.
    for (int w = 0; w < 3; ++w) {
      const double largest = std::max({size.x, size.y, size.z});
      if (largest == 0.0 || size[w] < 0.999 * largest) continue;
      const bool is_sure = std::count_if(&size[0], &size[0] + 3, [&](double s) { return s > 0.999 * largest; }) == 1;
      const int u = (w + 1) % 3, v = (w + 2) % 3;
      for (int y = 0; y < static_cast<int>(kResolution); ++y) {
        for (int x = 0; x < static_cast<int>(kResolution); ++x) {
          const glm::dvec2 p(x + 0.5, y + 0.5);
          double inside = 1e30;
          for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 &a = t[i], &b = t[(i + 1) % 3];
            const glm::dvec2 edge(b[u] - a[u], b[v] - a[v]);
            const double length = glm::length(edge);
            const double cross = edge.x * (p.y - a[v]) - edge.y * (p.x - a[u]);
            inside = std::min(inside, (n[w] > 0.0 ? cross : -cross) / std::max(length, 1e-12));
          }
          if (inside < -snap) continue;
          const double depth = t[0][w] - (n[u] * (p.x - t[0][u]) + n[v] * (p.y - t[0][v])) / n[w];
          const double spread = snap * (size[u] + size[v]) / size[w] + 1e-3;
          for (int z = static_cast<int>(std::floor(depth - spread)); z <= static_cast<int>(std::floor(depth + spread));
               ++z) {
            if (z < 0 || z >= static_cast<int>(kResolution)) continue;
            glm::uvec3 cell;
            cell[u] = static_cast<std::uint32_t>(x);
            cell[v] = static_cast<std::uint32_t>(y);
            cell[w] = static_cast<std::uint32_t>(z);
            may.insert(pack_cell(cell));
            if (is_sure && inside > snap && std::floor(depth - spread) == std::floor(depth + spread))
              must.insert(pack_cell(cell));
          }
        }
      }
    }
  }
  const std::vector<std::uint32_t> cells = built.occupied_cells();
  for (const std::uint32_t cell : cells) EXPECT_TRUE(may.contains(cell)) << cell;
  for (const std::uint32_t cell : must) EXPECT_TRUE(std::binary_search(cells.begin(), cells.end(), cell)) << cell;
  EXPECT_GT(must.size(), 1000u);
}

TEST_F(SvoTest, TrianglesThatAreNoPlacesMeetNothing) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const VoxelGrid grid = fit_voxel_grid(kUnit, 64);
  std::vector<Corners> triangles;
  std::mt19937 random(kSeed);
  for (Corners corners : random_triangles(grid, kSeed, 200)) {
    corners[random() % 3][static_cast<int>(random() % 3)] =
        random() % 2 == 0 ? kNan : (random() % 2 == 0 ? 1.0f : -1.0f) * kInfinity;
    triangles.push_back(corners);
  }
  for (const SvoVoxels voxels : {SvoVoxels::kRasterised, SvoVoxels::kConservative}) {
    const BuiltSvo built = build(triangles, kUnit, {.resolution = 64, .voxels = voxels, .records = true});
    EXPECT_EQ(built.counts[glsl::kSvoFragments], 0u);
    expect_tree_of_bits(built);
  }
}

// A floor that reaches far beyond the grid fills a layer, and triangles beyond what numbers can tell do no harm.
TEST_F(SvoTest, HugeTriangles) {
  const float y = 0.4f;
  const auto floor_of = [&](float side) {
    return std::vector<Corners>{
        {glm::vec3(-side, y, -side), glm::vec3(-side, y, 3 * side), glm::vec3(3 * side, y, -side)}};
  };
  for (const SvoVoxels voxels : {SvoVoxels::kRasterised, SvoVoxels::kConservative}) {
    const BuiltSvo built = build(floor_of(100.0f), kUnit, {.resolution = 64, .voxels = voxels});
    EXPECT_EQ(built.counts[glsl::kSvoFragments], 64u * 64u);
    expect_tree_of_bits(built);
    for (const float side : {1e6f, 1e18f, 1e30f, 3e38f})
      expect_tree_of_bits(build(floor_of(side), kUnit, {.resolution = 64, .voxels = voxels}));
  }
}

// The record of each occupied leaf, by packed cell.
std::map<std::uint32_t, glsl::SvoRecord> records_by_cell(const BuiltSvo& built) {
  std::map<std::uint32_t, glsl::SvoRecord> result;
  std::set<std::uint32_t> seen;
  const std::uint32_t count = built.counts[glsl::kSvoNodesUsed];
  for (std::uint32_t i = 0; i < count; ++i) {
    const glm::uvec4& node = built.nodes[i];
    if ((node.x & glsl::kSvoLeaf) == 0 || (node.x & glsl::kSvoOccupied) == 0) continue;
    EXPECT_LT(node.y, built.counts[glsl::kSvoLeaves]);
    EXPECT_TRUE(seen.insert(node.y).second);
    result[node.z] = built.records.at(node.y);
  }
  return result;
}

TEST_F(SvoTest, RecordsHoldTheMeanNormal) {
  const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, 0.9f, -0.2f));
  const glm::vec3 u = glm::normalize(glm::cross(normal, glm::vec3(1.0f, 0.0f, 0.0f)));
  const glm::vec3 v = glm::cross(normal, u);
  const glm::vec3 middle(0.5f);
  const std::vector<Corners> triangles{{middle - 0.3f * u, middle + 0.3f * u, middle + 0.3f * v},
                                       {middle + 0.3f * u, middle - 0.3f * u, middle - 0.3f * v}};
  const BuiltSvo built = build(triangles, kUnit, {.resolution = 64, .records = true});
  const auto records = records_by_cell(built);
  EXPECT_GT(records.size(), 500u);
  for (const auto& [cell, record] : records) {
    EXPECT_GT(record.weight, 0u);
    EXPECT_LT(glm::length(glm::vec3(record.normal_sum) / static_cast<float>(record.weight) - normal), 1e-3f);
  }
}

TEST_F(SvoTest, TheSameTreeEveryTime) {
  const VoxelGrid grid = fit_voxel_grid(kUnit, 64);
  const std::vector<Corners> triangles = random_triangles(grid, kSeed, 200);
  const BuiltSvo first = build(triangles, kUnit, {.resolution = 64, .records = true});
  const BuiltSvo second = build(triangles, kUnit, {.resolution = 64, .records = true});
  EXPECT_EQ(first.bits, second.bits);
  const auto a = records_by_cell(first), b = records_by_cell(second);
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [cell, record] : a) {
    EXPECT_EQ(record.normal_sum, b.at(cell).normal_sum);
    EXPECT_EQ(record.weight, b.at(cell).weight);
  }
}

TEST_F(SvoTest, NothingIsBuiltWhereNothingChanged) {
  const VoxelGrid grid = fit_voxel_grid(kUnit, 64);
  const std::vector<Corners> triangles = random_triangles(grid, kSeed, 50);
  const SvoSettings settings{.resolution = 64, .records = true};
  const auto frame = [&](const SvoSettings& asked, bool unchanged, std::size_t& passes) {
    FrameGraph graph(executor().context());
    const GpuScene::Frame scene = upload_triangles(graph, triangles);
    const std::size_t before = graph.passes().size();
    const Svo svo = record_svo(graph, scene, kUnit, asked, unchanged);
    passes = graph.passes().size() - before;
    return read(graph, svo);
  };
  std::size_t passes = 0;
  const BuiltSvo built = frame(settings, true, passes);  // there is nothing yet
  EXPECT_GT(passes, 10u);
  const BuiltSvo kept = frame(settings, true, passes);
  EXPECT_EQ(passes, 0u);
  EXPECT_EQ(kept.nodes, built.nodes);
  EXPECT_EQ(kept.bits, built.bits);
  EXPECT_EQ(kept.counts, built.counts);
  SvoSettings finer = settings;
  finer.resolution = 128;
  expect_tree_of_bits(frame(finer, true, passes));
  EXPECT_GT(passes, 10u);
}

}  // namespace
}  // namespace lightwell
