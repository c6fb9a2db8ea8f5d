#include "passes/svo/svo_memory.h"

#include <algorithm>
#include <bit>
#include <string>

#include "graph/pages.h"
#include "lightwell/error.h"
#include "passes/svo/svo_types.h"
#include "passes/voxelize/voxelize_types.h"

namespace lightwell {
namespace {

constexpr std::uint64_t kTileBytes = 8 * sizeof(glm::uvec4);

std::uint64_t cells(std::uint32_t level) {
  return std::uint64_t{1} << (3 * level);
}

// Of bricks along a side at that step of `coarse`.
std::uint32_t coarse_side_log2(std::uint32_t level, std::uint32_t step) {
  const std::uint32_t cell_log2 = 2 * (step + 2);
  return level > cell_log2 ? level - cell_log2 : 0;
}

// Of a tree whose depths down to `level` are all there; the root has a tile of its own.
std::uint64_t full_tiles(std::uint32_t level) {
  return 1 + (cells(level) - 1) / 7;
}

// Says whether the smallest buffers fit.
bool divide(std::uint32_t level, std::uint64_t level_count, std::uint64_t budget, std::uint64_t descriptor_range,
            bool records, SvoMemory& memory) {
  memory = {.level = level,
            .level_count = static_cast<std::uint32_t>(level_count),
            .bit_words = level_count * cells(level) / 32,
            .coarse_words = level_count * first_coarse_word(level, coarse_steps(level))};
  const std::uint64_t fixed =
      sizeof(std::uint32_t) * (memory.bit_words + memory.coarse_words + glsl::kSvoCountWords + glsl::kSvoArgumentWords);
  // A list of cells at an eighth of the resolution always fits (svo_relist.comp), and a tree of three levels.
  const std::uint64_t least_list = std::max<std::uint64_t>(level_count * cells(level - 3), 64);
  const std::uint64_t least_tiles = full_tiles(3);
  const std::uint64_t list_bytes = 2 * sizeof(std::uint32_t) + (records ? sizeof(glsl::SvoRecord) : 0);
  const std::uint64_t least = fixed + least_list * list_bytes + least_tiles * kTileBytes;
  if (level > 3 && (least > budget || memory.bit_words * sizeof(std::uint32_t) > descriptor_range)) return false;

  // Large triangles take a slower way where their list is full: those of all levels get an eighth at most.
  const std::uint64_t rest = budget > least ? budget - least : 0;
  const std::uint64_t plane_tiles = (cells(level) >> level) / (glsl::kTileSide * glsl::kTileSide);
  const std::uint64_t most_triangle_tiles =
      std::min(std::max<std::uint64_t>(1u << 17, 32 * plane_tiles),
               std::bit_floor(descriptor_range) * kMaximumPages / sizeof(glsl::VoxelTile));
  memory.triangle_tiles = static_cast<std::uint32_t>(
      std::clamp<std::uint64_t>(rest / 8 / level_count / sizeof(glsl::VoxelTile), 64, most_triangle_tiles));
  const std::uint64_t tile_bytes = level_count * memory.triangle_tiles * sizeof(glsl::VoxelTile);
  const std::uint64_t left = rest - std::min(rest, tile_bytes);

  // Surfaces make about one tile of the pool for three cells, all levels together; the list has room for four.
  constexpr std::uint64_t kCellsPerTile = 4;
  const std::uint64_t pairs = left / (kTileBytes + kCellsPerTile * list_bytes);
  const std::uint64_t most_tiles =
      std::min({full_tiles(level) + (level_count - 1) * cells(level - 1),
                std::bit_floor(descriptor_range) * kMaximumPages / kTileBytes, std::uint64_t{glsl::kSvoTileMask}});
  const std::uint64_t most_cells = std::min(
      level_count * cells(level), descriptor_range / (records ? sizeof(glsl::SvoRecord) : sizeof(std::uint32_t)));
  memory.node_tiles = static_cast<std::uint32_t>(std::min(least_tiles + pairs, most_tiles));
  memory.list_capacity = static_cast<std::uint32_t>(std::min(least_list + kCellsPerTile * pairs, most_cells));
  memory.bytes = fixed + memory.list_capacity * list_bytes + memory.node_tiles * kTileBytes + tile_bytes;
  return true;
}

}  // namespace

SvoMemory divide_svo_memory(std::uint32_t level, std::uint32_t level_count, std::uint64_t budget,
                            std::uint64_t descriptor_range, bool records) {
  LW_ASSERT(level >= 3 && level <= glsl::kSvoMaximumLevel, "2^" + std::to_string(level) + " cells a side");
  SvoMemory memory;
  while (!divide(level, level_count, budget, descriptor_range, records, memory)) --level;
  return memory;
}

std::uint32_t coarse_steps(std::uint32_t level) {
  std::uint32_t steps = 1;
  while (coarse_side_log2(level, steps - 1) > 0) ++steps;
  return steps;
}

std::uint64_t first_coarse_word(std::uint32_t level, std::uint32_t step) {
  std::uint64_t words = 0;
  for (std::uint32_t s = 0; s < step; ++s) words += 2 * cells(coarse_side_log2(level, s));
  return words;
}

}  // namespace lightwell
