// Octrees whose memory is short: a coarser tree, and words that say so.
#include "passes/svo/svo_memory.h"

#include <gtest/gtest.h>

#include <set>

#include "passes/svo/testing/svo_test_base.h"
#include "passes/svo/testing/tree_oracle.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 17;

using SvoMemoryTest = SvoTest;

TEST_F(SvoMemoryTest, APoolThatIsFullMakesACoarserTree) {
  constexpr std::uint32_t kResolution = 128;
  const VoxelGrid grid = fit_voxel_grid(kUnit, kResolution);
  const std::vector<Corners> triangles = random_triangles(grid, kSeed, 300);
  std::set<std::uint32_t> levels;
  bool pool_was_full = false;
  bool list_was_full = false;
  for (std::uint64_t budget = std::uint64_t{64} << 20; budget >= (std::uint64_t{400} << 10); budget = budget * 3 / 4) {
    SCOPED_TRACE("budget " + std::to_string(budget >> 10) + " KiB");
    for (const SvoVoxels voxels : {SvoVoxels::kRasterised, SvoVoxels::kConservative}) {
      const BuiltSvo built =
          build(triangles, kUnit, {.resolution = kResolution, .voxels = voxels, .budget = budget, .records = true});
      EXPECT_LE(built.svo.memory.bytes, budget);
      EXPECT_EQ(1u << built.level(), kResolution);
      expect_tree_of_bits(built);
      EXPECT_LE(built.counts[glsl::kSvoNodesUsed], 8 * built.svo.memory.node_tiles);
      if (built.counts[glsl::kSvoNodesWanted] > built.counts[glsl::kSvoNodesUsed]) {
        pool_was_full = true;
        EXPECT_GT(built.counts[glsl::kSvoNodesWanted], 8 * built.svo.memory.node_tiles);
      }
      const bool overflow = built.counts[glsl::kSvoListOverflow] != 0;
      EXPECT_EQ(overflow, built.counts[glsl::kSvoFragments] > built.svo.memory.list_capacity);
      list_was_full = list_was_full || overflow;
      levels.insert(built.reached());
    }
  }
  EXPECT_TRUE(pool_was_full);
  EXPECT_TRUE(list_was_full);
  EXPECT_GE(levels.size(), 3u);
  // Less still: the host asks for a coarser grid at once.
  const BuiltSvo small = build(triangles, kUnit, {.resolution = kResolution, .budget = 200 << 10});
  EXPECT_LT(1u << small.level(), kResolution);
  expect_tree_of_bits(small);
}

// A solid block: eight occupied cells a tile, more cells than the list expects.
TEST_F(SvoMemoryTest, AListThatIsFullMakesACoarserTree) {
  std::vector<Corners> planes;
  for (int i = 0; i < 128; ++i) {
    const float z = (static_cast<float>(i) + 0.5f) / 128.0f;
    planes.push_back({glm::vec3(0.0f, 0.0f, z), glm::vec3(2.0f, 0.0f, z), glm::vec3(0.0f, 2.0f, z)});
  }
  std::set<std::uint32_t> list_levels;
  for (const std::uint64_t budget : {std::uint64_t{3000} << 10, std::uint64_t{600} << 10, std::uint64_t{200} << 10}) {
    SCOPED_TRACE("budget " + std::to_string(budget >> 10) + " KiB");
    const BuiltSvo built = build(planes, kUnit, {.resolution = 64, .budget = budget});
    ASSERT_EQ(built.level(), 6u);
    expect_tree_of_bits(built);
    EXPECT_EQ(built.counts[glsl::kSvoListOverflow], 1u);
    list_levels.insert(built.counts[glsl::kSvoListLevel]);
  }
  EXPECT_EQ(list_levels, (std::set<std::uint32_t>{3u, 4u, 5u}));
}

TEST_F(SvoMemoryTest, APoolInPagesHoldsTheSameTree) {
  const std::uint64_t range = executor().context().descriptor_range;
  executor().context().descriptor_range = 64 << 10;
  const VoxelGrid grid = fit_voxel_grid(kUnit, 64);
  const BuiltSvo built = build(random_triangles(grid, kSeed, 60), kUnit, {.resolution = 64});
  executor().context().descriptor_range = range;
  EXPECT_GT(built.counts[glsl::kSvoNodesUsed], (64u << 10) / 16u) << "one page would do";
  EXPECT_EQ(built.level(), 6u);
  expect_tree_of_bits(built);
}

TEST(SvoMemory, FitsTheBudget) {
  constexpr std::uint64_t kRange = std::uint64_t{128} << 20;
  for (std::uint32_t level = 3; level <= 10; ++level) {
    for (std::uint64_t budget = 64 << 10; budget <= std::uint64_t{4} << 30; budget *= 2) {
      const SvoMemory memory = divide_svo_memory(level, 1, budget, kRange, true);
      EXPECT_LE(memory.level, level);
      if (memory.level > 3 || budget >= 256 << 10) {
        EXPECT_LE(memory.bytes, budget) << level;
      }
      EXPECT_LE(memory.list_capacity, std::uint64_t{1} << (3 * memory.level));
      EXPECT_LE(std::uint64_t{memory.node_tiles} * 128, 4 * kRange);
    }
  }
  EXPECT_EQ(divide_svo_memory(10, 1, std::uint64_t{1} << 30, kRange, false).level, 10u);
  EXPECT_EQ(divide_svo_memory(10, 1, std::uint64_t{100} << 20, kRange, false).level, 9u);
  EXPECT_LT(divide_svo_memory(10, 1, std::uint64_t{1} << 30, kRange / 2, false).level, 10u);
}

}  // namespace
}  // namespace lightwell
