#include "core/ssim.h"

namespace lightwell {

namespace {

Plane blur(const Plane& plane) {
  std::vector<double> kernel = gaussian_kernel(1.5, 5);
  normalize(kernel);
  return filter_separable(plane, kernel, kernel, Border::kReflect);
}

Plane product(const Plane& a, const Plane& b) {
  Plane result(a.width, a.height);
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] = a.values[i] * b.values[i];
  return result;
}

}  // namespace

Plane ssim_map(const Plane& a, const Plane& b) {
  constexpr double kC1 = 0.01 * 0.01;
  constexpr double kC2 = 0.03 * 0.03;
  const Plane mean_a = blur(a), mean_b = blur(b);
  const Plane mean_aa = blur(product(a, a)), mean_bb = blur(product(b, b)), mean_ab = blur(product(a, b));
  Plane map(a.width, a.height);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const double ma = mean_a.values[i], mb = mean_b.values[i];
    const double variances = (mean_aa.values[i] - ma * ma) + (mean_bb.values[i] - mb * mb);
    const double covariance = mean_ab.values[i] - ma * mb;
    map.values[i] = (2 * ma * mb + kC1) * (2 * covariance + kC2) / ((ma * ma + mb * mb + kC1) * (variances + kC2));
  }
  return map;
}

}  // namespace lightwell
