#include "passes/environment/environment_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/luminance.h"

namespace lightwell {
namespace {

// Luminance of every texel, as doubles: a sun may be 1e10 times brighter than its sky.
std::vector<double> texel_luminances(const Environment& environment) {
  const Image& map = environment.map;
  std::vector<double> luminances;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const float* rgb = map.at(x, y);
      const glm::dvec3 radiance = glm::dvec3(environment.radiance) * glm::dvec3(rgb[0], rgb[1], rgb[2]);
      luminances.push_back(std::max(luminance(radiance), 0.0));
    }
  }
  return luminances;
}

// Light is interpolated between texels, so a texel's square holds some of its neighbours' light: weights 1, 6, 1 along
// each axis give its mean. Columns wrap round, rows end at the poles.
std::vector<double> mean_over_texels(const std::vector<double>& texels, int width, int height) {
  const auto at = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  std::vector<double> across(texels.size());
  std::vector<double> means(texels.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      across[at(x, y)] = 0.125 * texels[at((x + width - 1) % width, y)] + 0.75 * texels[at(x, y)] +
                         0.125 * texels[at((x + 1) % width, y)];
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      means[at(x, y)] = 0.125 * across[at(x, std::max(y - 1, 0))] + 0.75 * across[at(x, y)] +
                        0.125 * across[at(x, std::min(y + 1, height - 1))];
    }
  }
  return means;
}

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
  const std::vector<double> means = mean_over_texels(texel_luminances(environment), map.width, map.height);
  if (std::all_of(means.begin(), means.end(), [](double mean) { return mean == 0.0; })) return {};

  const int side = (map.width + kMaxTableWidth - 1) / kMaxTableWidth;  // texels along a cell
  const int width = map.width / side;
  const int height = std::max(map.height / side, 1);
  EnvironmentTable table;
  table.width = static_cast<std::uint32_t>(width);
  table.height = static_cast<std::uint32_t>(height);
  std::vector<double> cells(std::size_t{table.width} * table.height);
  auto mean = means.begin();
  for (int y = 0; y < map.height; ++y) {
    const auto row = static_cast<std::size_t>(std::int64_t{y} * height / map.height);
    for (int x = 0; x < map.width; ++x, ++mean)
      cells[row * table.width + static_cast<std::size_t>(std::int64_t{x} * width / map.width)] += *mean;
  }
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
