#include "core/plane.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lightwell/error.h"

namespace lightwell {

namespace {

int wrap(int i, int size, Border border) {
  if (border == Border::kReplicate || size == 1) return std::clamp(i, 0, size - 1);
  const int period = 2 * (size - 1);
  const int phase = ((i % period) + period) % period;
  return phase < size ? phase : period - phase;
}

}  // namespace

Plane filter_separable(const Plane& plane, std::span<const double> kernel_x, std::span<const double> kernel_y,
                       Border border) {
  LW_ASSERT(kernel_x.size() % 2 == 1 && kernel_y.size() % 2 == 1,
            std::to_string(kernel_x.size()) + ", " + std::to_string(kernel_y.size()));
  const int radius_x = static_cast<int>(kernel_x.size() / 2);
  const int radius_y = static_cast<int>(kernel_y.size() / 2);
  const auto width = static_cast<std::size_t>(plane.width);

  Plane columns(plane.width, plane.height);
  for (int y = 0; y < plane.height; ++y) {
    double* out = &columns.at(0, y);
    for (int k = -radius_y; k <= radius_y; ++k) {
      const double weight = kernel_y[static_cast<std::size_t>(k + radius_y)];
      const double* in = plane.values.data() + static_cast<std::size_t>(wrap(y + k, plane.height, border)) * width;
      for (std::size_t x = 0; x < width; ++x) out[x] += weight * in[x];
    }
  }

  Plane filtered(plane.width, plane.height);
  std::vector<double> row(width + 2 * static_cast<std::size_t>(radius_x));  // with its borders
  for (int y = 0; y < plane.height; ++y) {
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = columns.at(wrap(static_cast<int>(i) - radius_x, plane.width, border), y);
    double* out = &filtered.at(0, y);
    for (std::size_t k = 0; k < kernel_x.size(); ++k)
      for (std::size_t x = 0; x < width; ++x) out[x] += kernel_x[k] * row[x + k];
  }
  return filtered;
}

std::vector<double> gaussian_kernel(double sigma, int radius) {
  std::vector<double> kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(std::exp(-0.5 * (x / sigma) * (x / sigma)));
  return kernel;
}

void normalize(std::vector<double>& kernel) {
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& value : kernel) value /= sum;
}

}  // namespace lightwell
