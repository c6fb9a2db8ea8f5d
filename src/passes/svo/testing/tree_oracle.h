// What the octree must be, built on the CPU from the bits that the device made.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "passes/svo/testing/svo_test_base.h"

namespace lightwell {

// Packed cells of one level's occupied nodes, sorted.
inline std::vector<std::uint32_t> coarser(const std::vector<std::uint32_t>& cells, std::uint32_t shift) {
  std::vector<std::uint32_t> result;
  for (const std::uint32_t cell : cells) result.push_back(pack_cell(unpack_cell(cell) >> shift));
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

// Walks the device's tree from the root: every node's bits and box, each occupied node where the CPU has one, no tile
// used twice, none left over.
inline void expect_tree_of_bits(const BuiltSvo& built) {
  const std::uint32_t level = built.level();
  const std::uint32_t reached = built.reached();
  ASSERT_LE(reached, level);
  const std::vector<std::uint32_t> cells = built.occupied_cells();
  ASSERT_EQ(built.counts[glsl::kSvoFragments], cells.size());
  std::vector<std::vector<std::uint32_t>> truth;
  for (std::uint32_t depth = 0; depth <= reached; ++depth) truth.push_back(coarser(cells, level - depth));

  struct Place {
    std::uint32_t node, depth;
    glm::uvec3 cell;
  };
  std::vector<Place> stack{{0, 0, glm::uvec3(0)}};
  std::vector<std::size_t> occupied(reached + 1, 0);
  std::vector<bool> tile_seen(built.svo.memory.node_tiles, false);
  std::size_t tiles = 1;
  while (!stack.empty()) {
    const Place place = stack.back();
    stack.pop_back();
    ASSERT_LT(place.node, built.nodes.size());
    const glm::uvec4 node = built.nodes[place.node];
    const bool is_occupied = (node.x & glsl::kSvoOccupied) != 0;
    const bool is_leaf = (node.x & glsl::kSvoLeaf) != 0;
    const std::uint32_t side = 1u << (level - place.depth);
    ASSERT_EQ(node.z, pack_cell(place.cell * side));
    ASSERT_EQ(node.w, pack_cell(place.cell * side + side - 1u));
    const auto& expected = truth[place.depth];
    ASSERT_EQ(is_occupied, std::binary_search(expected.begin(), expected.end(), pack_cell(place.cell)))
        << "depth " << place.depth;
    occupied[place.depth] += is_occupied ? 1 : 0;
    ASSERT_EQ(is_leaf, !is_occupied || place.depth == reached);
    if (is_leaf) {
      ASSERT_EQ(node.x & glsl::kSvoTileMask, 0u);
      continue;
    }
    const std::uint32_t tile = node.x & glsl::kSvoTileMask;
    ASSERT_LT(tile, tile_seen.size());
    ASSERT_FALSE(tile_seen[tile]);
    tile_seen[tile] = true;
    ++tiles;
    for (std::uint32_t i = 0; i < 8; ++i)
      stack.push_back({8 * tile + i, place.depth + 1, 2u * place.cell + (glm::uvec3(i, i >> 1, i >> 2) & 1u)});
  }
  for (std::uint32_t depth = 0; depth <= reached; ++depth) EXPECT_EQ(occupied[depth], truth[depth].size());
  EXPECT_EQ(built.counts[glsl::kSvoNodesUsed], 8 * tiles);
  EXPECT_EQ(built.counts[glsl::kSvoLeaves], truth[reached].size());
  EXPECT_EQ(built.counts[glsl::kSvoLevelBuilt], level);
  const bool is_whole = reached == level;
  const std::size_t refused = reached < built.counts[glsl::kSvoListLevel] ? truth[reached].size() : 0;
  EXPECT_EQ(built.counts[glsl::kSvoNodesWanted], 8 * (tiles + refused));
  EXPECT_TRUE(is_whole || refused > 0 || built.counts[glsl::kSvoListOverflow] != 0);
}

// The coarser levels of the bit grid hold a bit a brick.
inline void expect_coarse_bits(const BuiltSvo& built) {
  std::vector<std::uint32_t> fine = built.bits;
  std::uint32_t fine_log2 = built.level() - 2;
  for (std::uint32_t step = 0; step < coarse_steps(built.level()); ++step) {
    const std::uint32_t log2 = std::max(fine_log2, 2u) - 2;
    std::vector<std::uint32_t> expected(2 * (std::size_t{1} << (3 * log2)), 0);
    for (std::size_t brick = 0; brick < fine.size() / 2; ++brick) {
      if ((fine[2 * brick] | fine[2 * brick + 1]) == 0) continue;
      const auto b = static_cast<std::uint32_t>(brick);
      const glm::uvec3 at = glm::uvec3(b, b >> fine_log2, b >> (2 * fine_log2)) & ((1u << fine_log2) - 1u);
      const glm::uvec3 parent = at >> 2u;
      const std::uint32_t bit = (at.x & 3u) | ((at.y & 3u) << 2) | ((at.z & 3u) << 4);
      expected[2 * (parent.x | (parent.y << log2) | (parent.z << (2 * log2))) + bit / 32] |= 1u << (bit % 32);
    }
    const std::uint64_t first = first_coarse_word(built.level(), step);
    const std::vector<std::uint32_t> found(built.coarse.begin() + static_cast<std::ptrdiff_t>(first),
                                           built.coarse.begin() + static_cast<std::ptrdiff_t>(first + expected.size()));
    EXPECT_EQ(found, expected) << "step " << step;
    fine = expected;
    fine_log2 = log2;
  }
}

}  // namespace lightwell
