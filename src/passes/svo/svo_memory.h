// How the octree's buffers divide a budget of memory.
#pragma once

#include <cstdint>

namespace lightwell {

struct SvoMemory {
  std::uint32_t level = 3;  // log2 of the cells a side of each level of the grid
  std::uint32_t level_count = 1;
  std::uint64_t bit_words = 0;       // of the bit grid
  std::uint64_t coarse_words = 0;    // of its coarser levels
  std::uint32_t list_capacity = 0;   // cells
  std::uint32_t node_tiles = 0;      // of 8 nodes each
  std::uint32_t triangle_tiles = 0;  // of large triangles, conservative voxelisation
  std::uint64_t bytes = 0;           // of all buffers together
};

// For a grid of `level_count` levels of 2^level cells a side, 3 <= level <= 10, or the finest coarser one whose bit
// grid, smallest list and smallest pool fit into `budget` bytes and into descriptors that reach `descriptor_range` (2^3
// always does). No buffer is larger than the grid could ever need.
SvoMemory divide_svo_memory(std::uint32_t level, std::uint32_t level_count, std::uint64_t budget,
                            std::uint64_t descriptor_range, bool records);

// First word, from a level's own first one in `coarse`, of those whose bits stand for 4^(step + 1) cells a side.
std::uint64_t first_coarse_word(std::uint32_t level, std::uint32_t step);
// How many such steps there are: the last is one brick.
std::uint32_t coarse_steps(std::uint32_t level);

}  // namespace lightwell
