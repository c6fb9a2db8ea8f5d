// What the octree over several levels must be, built on the CPU from the bits that the device made.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include "passes/svo/testing/svo_test_base.h"

namespace lightwell {

// A cube of 2^shift finest cells a side: `cell` is its place in units of itself, from the coarsest level's lower
// corner.
struct TreeBox {
  std::uint32_t shift;
  glm::ivec3 cell;

  bool operator<(const TreeBox& other) const { return key() < other.key(); }
  bool operator==(const TreeBox& other) const { return key() == other.key(); }
  TreeBox coarser(std::uint32_t other) const {
    return other <= shift ? *this : TreeBox{other, cell >> static_cast<int>(other - shift)};
  }

 private:
  std::array<std::int64_t, 4> key() const { return {shift, cell.x, cell.y, cell.z}; }
};

inline bool in_window(const SvoLevels& levels, std::uint32_t level, const glm::ivec3& finest_cell) {
  const glm::ivec3 inside = (finest_cell >> static_cast<int>(level)) - levels.lower[level];
  return glm::all(glm::greaterThanEqual(inside, glm::ivec3(0))) &&
         glm::all(glm::lessThan(inside, glm::ivec3(static_cast<int>(levels.levels.resolution))));
}

// Occupied cells of one level, from its window's lower corner.
inline std::vector<glm::ivec3> occupied_cells(const BuiltSvo& built, std::uint32_t level) {
  const std::uint32_t log2 = built.level() - 2, mask = (1u << log2) - 1u;
  const std::size_t words = std::size_t{2} << (3 * log2);
  std::vector<glm::ivec3> cells;
  for (std::size_t i = 0; i < words; ++i) {
    const std::uint32_t word = built.bits[level * words + i];
    const auto brick = static_cast<std::uint32_t>(i / 2);
    const glm::ivec3 first = 4 * glm::ivec3(brick & mask, (brick >> log2) & mask, brick >> (2 * log2));
    for (std::uint32_t b = 0; b < 32; ++b)
      if (((word >> b) & 1u) != 0) cells.push_back(first + glm::ivec3(b & 3u, (b >> 2) & 3u, (b >> 4) + 2 * (i % 2)));
  }
  return cells;
}

// The tree's occupied leaves, where list and pool were as large as the counts say: each level's cells, but for those
// that a finer level's window holds.
inline std::set<TreeBox> expected_leaves(const BuiltSvo& built) {
  const SvoLevels& levels = built.svo.levels;
  const std::uint32_t deepest = built.level() + levels.levels.count - 1;
  const std::uint32_t enlarged = built.level() - built.counts[glsl::kSvoListLevel];
  std::set<TreeBox> leaves;
  for (std::uint32_t level = 0; level < levels.levels.count; ++level) {
    for (const glm::ivec3& cell : occupied_cells(built, level)) {
      const TreeBox box{level, cell + levels.lower[level]};
      if (level > 0 && in_window(levels, level - 1, box.cell << static_cast<int>(level))) continue;
      leaves.insert(box.coarser(level + enlarged).coarser(deepest - built.reached()));
    }
  }
  return leaves;
}

// Walks the device's tree from the root.
inline void expect_tree_of_levels(const BuiltSvo& built) {
  const SvoLevels& levels = built.svo.levels;
  const std::uint32_t deepest = built.level() + levels.levels.count - 1;
  const std::set<TreeBox> expected = expected_leaves(built);
  std::set<TreeBox> found;
  std::vector<bool> tile_seen(built.svo.memory.node_tiles, false);
  std::size_t tiles = 1;
  struct Place {
    std::uint32_t node;
    TreeBox box;
  };
  std::vector<Place> stack{{0, {deepest, glm::ivec3(0)}}};
  while (!stack.empty()) {
    const auto [index, box] = stack.back();
    stack.pop_back();
    ASSERT_LT(index, built.nodes.size());
    const glm::uvec4 node = built.nodes[index];
    // Its box, in cells of its level.
    const std::uint32_t level = std::min(box.shift, levels.levels.count - 1);
    ASSERT_EQ((node.x >> glsl::kSvoLevelShift) & glsl::kSvoLevelMask, level);
    const int side = 1 << (box.shift - level);
    const glm::ivec3 low = box.cell * side - levels.lower[level];
    ASSERT_EQ(glm::ivec3(unpack_cell(node.z)), low);
    ASSERT_EQ(glm::ivec3(unpack_cell(node.w)), low + side - 1);
    const bool is_occupied = (node.x & glsl::kSvoOccupied) != 0;
    if ((node.x & glsl::kSvoLeaf) != 0) {
      ASSERT_EQ(node.x & glsl::kSvoTileMask, 0u);
      if (is_occupied) found.insert(box);
      continue;
    }
    ASSERT_TRUE(is_occupied);
    ASSERT_GT(box.shift, 0u);
    const std::uint32_t tile = node.x & glsl::kSvoTileMask;
    ASSERT_LT(tile, tile_seen.size());
    ASSERT_FALSE(tile_seen[tile]);
    tile_seen[tile] = true;
    ++tiles;
    for (std::uint32_t i = 0; i < 8; ++i)
      stack.push_back({8 * tile + i, {box.shift - 1, 2 * box.cell + (glm::ivec3(i, i >> 1, i >> 2) & 1)}});
  }
  EXPECT_EQ(found.size(), expected.size());
  EXPECT_TRUE(found == expected);
  EXPECT_EQ(built.counts[glsl::kSvoNodesUsed], 8 * tiles);
  EXPECT_EQ(built.counts[glsl::kSvoLeaves], found.size());
}

}  // namespace lightwell
