// Which directions of an environment's map matter: the table that samples are drawn from.
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/scene.h"

namespace lightwell {

// Probability in proportion to mean luminance times solid angle of each cell of width x height cells that cover the map
// (cells are texels, or squares of them where the map is larger than kMaxTableWidth), as running sums that end at 1
// (Pharr, Jakob and Humphreys 2016, Sec. 14.2.4): first one value a row of cells, then one a cell within its row.
// Rising values of the two random numbers move across the map without jumps, so stratified numbers stay stratified.
struct EnvironmentTable {
  std::uint32_t width = 0;  // 0: the environment is constant, or black
  std::uint32_t height = 0;
  std::vector<float> cumulative;  // height + height * width
};

inline constexpr int kMaxTableWidth = 4096;

EnvironmentTable make_environment_table(const Environment& environment);

}  // namespace lightwell
