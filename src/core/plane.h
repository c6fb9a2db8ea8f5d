// One channel of an image in double precision, and separable filters on it: what SSIM and FLIP are computed with.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace lightwell {

struct Plane {
  int width = 0;
  int height = 0;
  std::vector<double> values;

  Plane() = default;
  Plane(int width_, int height_)
      : width(width_), height(height_), values(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}

  double& at(int x, int y) { return values[index(x, y)]; }
  double at(int x, int y) const { return values[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

using Planes = std::array<Plane, 3>;  // R, G, B or another colour space's three

// What lies outside: the edge pixel again, or the image mirrored at the centre of the edge pixel.
enum class Border { kReplicate, kReflect };

// Correlates rows with `kernel_x` and columns with `kernel_y`, both of odd length and centred.
Plane filter_separable(const Plane& plane, std::span<const double> kernel_x, std::span<const double> kernel_y,
                       Border border);

// exp(-x^2 / (2 sigma^2)) for x in [-radius, radius], not normalised.
std::vector<double> gaussian_kernel(double sigma, int radius);

// Scales the kernel so that its values sum to 1.
void normalize(std::vector<double>& kernel);

}  // namespace lightwell
