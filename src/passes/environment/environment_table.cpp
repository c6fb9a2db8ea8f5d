#include "passes/environment/environment_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/luminance.h"

namespace lightwell {
namespace {

// Light is interpolated between texels, so a texel's square holds some of its neighbours' light: weights 1, 6, 1 along
// each axis give the square's mean. Columns wrap round, rows end at the poles. Luminance (ITU-R BT.709) in doubles: a
// sun may be 1e10 times brighter than its sky.
class MeanRows {
 public:
  explicit MeanRows(const Environment& environment)
      : environment_(environment), luminances_(static_cast<std::size_t>(environment.map.width)) {
    for (std::vector<double>& row : across_) row.resize(luminances_.size());
  }

  // Means of the texels of row y. Rows must be asked for in order.
  const std::vector<double>& compute(int y) {
    const int last = environment_.map.height - 1;
    if (y == 0) {
      average_across(0, across_[1]);
      across_[0] = across_[1];
    } else {
      std::rotate(across_.begin(), across_.begin() + 1, across_.end());
    }
    if (y < last)
      average_across(y + 1, across_[2]);
    else
      across_[2] = across_[1];
    for (std::size_t x = 0; x < luminances_.size(); ++x)
      luminances_[x] = 0.125 * across_[0][x] + 0.75 * across_[1][x] + 0.125 * across_[2][x];
    return luminances_;
  }

 private:
  void average_across(int y, std::vector<double>& row) {
    const std::size_t width = luminances_.size();
    const glm::vec3& radiance = environment_.radiance;
    for (std::size_t x = 0; x < width; ++x) {
      const float* rgb = environment_.map.at(static_cast<int>(x), y);
      luminances_[x] = std::max(luminance(glm::dvec3(radiance) * glm::dvec3(rgb[0], rgb[1], rgb[2])), 0.0);
    }
    for (std::size_t x = 0; x < width; ++x)
      row[x] = 0.125 * luminances_[x > 0 ? x - 1 : width - 1] + 0.75 * luminances_[x] +
               0.125 * luminances_[x + 1 < width ? x + 1 : 0];
  }

  const Environment& environment_;
  std::vector<double> luminances_;             // of the texels of one row, then their means
  std::array<std::vector<double>, 3> across_;  // means along the rows above, at and below y
};

// Running sums of `weights`, ending at 1; even where there is nothing. Returns the sum.
double write_running_sums(const std::vector<double>& weights, float* sums) {
  double total = 0.0;
  for (const double weight : weights) total += weight;
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += total > 0.0 ? weights[i] / total : 1.0 / static_cast<double>(weights.size());
    sums[i] = i + 1 < weights.size() ? static_cast<float>(std::min(sum, 1.0)) : 1.0f;
  }
  return total;
}

}  // namespace

EnvironmentTable make_environment_table(const Environment& environment) {
  const Image& map = environment.map;
  if (map.width <= 0 || map.height <= 0) return {};
  const int side = (map.width + kMaxTableWidth - 1) / kMaxTableWidth;  // texels along a cell
  const int width = map.width / side;
  const int height = std::max(map.height / side, 1);
  EnvironmentTable table;
  table.width = static_cast<std::uint32_t>(width);
  table.height = static_cast<std::uint32_t>(height);
  std::vector<double> cells(std::size_t{table.width} * table.height);
  MeanRows means(environment);
  for (int y = 0; y < map.height; ++y) {
    const auto row = static_cast<std::size_t>(std::int64_t{y} * height / map.height);
    const std::vector<double>& mean = means.compute(y);
    for (int x = 0; x < map.width; ++x)
      cells[row * table.width + static_cast<std::size_t>(std::int64_t{x} * width / map.width)] +=
          mean[static_cast<std::size_t>(x)];
  }
  if (std::all_of(cells.begin(), cells.end(), [](double cell) { return cell == 0.0; })) return {};
  table.cumulative.resize(table.height + cells.size());
  std::vector<double> rows;
  for (std::uint32_t y = 0; y < table.height; ++y) {
    const auto first = cells.begin() + static_cast<std::ptrdiff_t>(std::size_t{y} * table.width);
    const double sum = write_running_sums({first, first + static_cast<std::ptrdiff_t>(table.width)},
                                          table.cumulative.data() + table.height + std::size_t{y} * table.width);
    // A row's solid angle is in proportion to the sine of its polar angle.
    rows.push_back(sum * std::sin(std::numbers::pi * (y + 0.5) / table.height));
  }
  write_running_sums(rows, table.cumulative.data());
  return table;
}

}  // namespace lightwell
