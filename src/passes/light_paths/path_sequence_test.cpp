#include "passes/light_paths/path_sequence.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

#include "passes/light_paths/light_path_dimensions.h"

namespace lightwell {
namespace {

// Digits of point `index`, the first in bit 0.
std::uint32_t point_digits(const std::vector<std::uint32_t>& matrices, std::uint32_t dimension, std::uint32_t index) {
  std::uint32_t digits = 0;
  for (std::uint32_t bit = 0; bit < 32; ++bit)
    if ((index >> bit & 1u) != 0) digits ^= matrices[32 * dimension + bit];
  return digits;
}

// Of any 2^k points from a multiple of 2^k on, each of the 2^k intervals of every dimension holds one.
TEST(SobolMatrices, EveryDimensionIsStratified) {
  const std::vector<std::uint32_t> matrices = make_sobol_matrices();
  ASSERT_EQ(matrices.size(), 32u * glsl::kJointDimensions);
  for (std::uint32_t dimension = 0; dimension < glsl::kJointDimensions; ++dimension) {
    for (const std::uint32_t k : {1u, 4u, 10u}) {
      for (const std::uint32_t first : {0u, 1u, 1000u, (1u << (32 - k)) - 1}) {
        std::set<std::uint32_t> intervals;
        for (std::uint32_t i = 0; i < 1u << k; ++i)
          intervals.insert(point_digits(matrices, dimension, (first << k) + i) & ((1u << k) - 1));
        ASSERT_EQ(intervals.size(), 1u << k) << "dimension " << dimension;
      }
    }
  }
}

// Of the first two dimensions each rectangle of area 2^-k holds one of 2^k points, whatever its shape.
TEST(SobolMatrices, TheStartIsStratifiedInAllWays) {
  const std::vector<std::uint32_t> matrices = make_sobol_matrices();
  constexpr std::uint32_t kBits = 8;
  for (std::uint32_t wide = 0; wide <= kBits; ++wide) {
    std::set<std::uint32_t> cells;
    for (std::uint32_t i = 0; i < 1u << kBits; ++i) {
      const std::uint32_t x = point_digits(matrices, 0, i) & ((1u << wide) - 1);
      const std::uint32_t y = point_digits(matrices, 1, i) & ((1u << (kBits - wide)) - 1);
      cells.insert(y << wide | x);
    }
    ASSERT_EQ(cells.size(), 1u << kBits) << wide << " bits of the first";
  }
}

}  // namespace
}  // namespace lightwell
