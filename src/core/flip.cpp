// Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating
// Images". Names and constants are the paper's: a color pipeline, a feature pipeline, and their combination.
#include "core/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/ext/vector_double3.hpp>

#include "core/color.h"
#include "core/color_space.h"

namespace lightwell {

namespace {

using std::numbers::pi;

// Contrast sensitivity of one opponent channel in space: the sum of two Gaussians
// a sqrt(pi/b) exp(-pi^2 d^2 / b), d in degrees.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> kSensitivities = {
    {{1.0, 0.0047, 0.0, 1e-5}, {1.0, 0.0053, 0.0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};
constexpr double kWidestB = 0.04;

constexpr double kColorExponent = 0.7;          // q_c
constexpr double kColorKnee = 0.4;              // p_c
constexpr double kColorKneeValue = 0.95;        // p_t
constexpr double kFeatureExponent = 0.5;        // q_f
constexpr double kFeatureWidthDegrees = 0.082;  // w, of the features that an eye detects

Planes opponent_planes(const Planes& display) {
  Planes result;
  for (Plane& plane : result) plane = Plane(display[0].width, display[0].height);
  for (std::size_t i = 0; i < display[0].values.size(); ++i) {
    const glm::dvec3 linear(linear_from_srgb(display[0].values[i]), linear_from_srgb(display[1].values[i]),
                            linear_from_srgb(display[2].values[i]));
    const glm::dvec3 opponents = ycxcz_from_rgb(linear);
    for (int c = 0; c < 3; ++c) result[static_cast<std::size_t>(c)].values[i] = opponents[c];
  }
  return result;
}

// Removes what is too fine to be seen from this distance. A sum of two Gaussians is not separable, but each of them is.
Plane filter_by_sensitivity(const Plane& plane, const Sensitivity& s, double pixels_per_degree) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidestB / (2 * pi * pi)) * pixels_per_degree));
  Plane result(plane.width, plane.height);
  double total = 0;
  const auto add_gaussian = [&](double a, double b) {
    if (a == 0) return;
    // exp(-pi^2 d^2 / b) has sigma = sqrt(b / (2 pi^2)) degrees.
    const std::vector<double> kernel = gaussian_kernel(std::sqrt(b / (2 * pi * pi)) * pixels_per_degree, radius);
    double sum = 0;
    for (double value : kernel) sum += value;
    const double weight = a * std::sqrt(pi / b);
    const Plane filtered = filter_separable(plane, kernel, kernel, Border::kReplicate);
    for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] += weight * filtered.values[i];
    total += weight * sum * sum;
  };
  add_gaussian(s.a1, s.b1);
  add_gaussian(s.a2, s.b2);
  for (double& value : result.values) value /= total;
  return result;
}

// L*a*b* with chroma scaled by luminance: colours look less colourful in the dark (Hunt effect).
glm::dvec3 hunt_lab(const glm::dvec3& linear_rgb) {
  const glm::dvec3 lab = lab_from_rgb(linear_rgb);
  return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

// HyAB: city block between luminance and chroma, Euclidean within chroma.
double hyab(const glm::dvec3& a, const glm::dvec3& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// Compresses large distances, then gives the range below the knee most of [0,1].
double redistribute(double distance) {
  static const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kColorExponent);
  const double compressed = std::pow(distance, kColorExponent);
  const double knee = kColorKnee * largest;
  if (compressed < knee) return kColorKneeValue * compressed / knee;
  return kColorKneeValue + (compressed - knee) / (largest - knee) * (1 - kColorKneeValue);
}

// The color pipeline, on opponent images.
Plane color_difference(const Planes& test, const Planes& reference, double pixels_per_degree) {
  Planes t, r;
  for (std::size_t c = 0; c < 3; ++c) {
    t[c] = filter_by_sensitivity(test[c], kSensitivities[c], pixels_per_degree);
    r[c] = filter_by_sensitivity(reference[c], kSensitivities[c], pixels_per_degree);
  }
  Plane difference(t[0].width, t[0].height);
  for (std::size_t i = 0; i < difference.values.size(); ++i) {
    const auto perceived = [i](const Planes& p) {
      const glm::dvec3 rgb = rgb_from_ycxcz({p[0].values[i], p[1].values[i], p[2].values[i]});
      return hunt_lab(glm::clamp(rgb, 0.0, 1.0));
    };
    difference.values[i] = redistribute(hyab(perceived(t), perceived(r)));
  }
  return difference;
}

enum class Feature { kEdge, kPoint };

// Length of the gradient (edges) or of the second derivatives (points) of luminance. The positive and
// the negative weights of the derivative sum to one each.
Plane feature_strength(const Plane& luminance, Feature feature, double pixels_per_degree) {
  const double sigma = 0.5 * kFeatureWidthDegrees * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  std::vector<double> smooth = gaussian_kernel(sigma, radius);
  std::vector<double> derivative = smooth;
  for (int x = -radius; x <= radius; ++x)
    derivative[static_cast<std::size_t>(x + radius)] *= feature == Feature::kEdge ? -x : x * x / (sigma * sigma) - 1;
  normalize(smooth);
  double positive = 0, negative = 0;
  for (double value : derivative) (value > 0 ? positive : negative) += std::abs(value);
  for (double& value : derivative) value /= value > 0 ? positive : negative;

  const Plane along_x = filter_separable(luminance, derivative, smooth, Border::kReplicate);
  const Plane along_y = filter_separable(luminance, smooth, derivative, Border::kReplicate);
  Plane strength(luminance.width, luminance.height);
  for (std::size_t i = 0; i < strength.values.size(); ++i)
    strength.values[i] = std::hypot(along_x.values[i], along_y.values[i]);
  return strength;
}

// The feature pipeline, on Y of opponent images.
Plane feature_difference(Plane test, Plane reference, double pixels_per_degree) {
  for (Plane* plane : {&test, &reference})
    for (double& value : plane->values) value = (value + 16) / 116;  // Y of YCxCz to luminance in [0,1]
  Plane difference(test.width, test.height);
  for (const Feature feature : {Feature::kEdge, Feature::kPoint}) {
    const Plane t = feature_strength(test, feature, pixels_per_degree);
    const Plane r = feature_strength(reference, feature, pixels_per_degree);
    for (std::size_t i = 0; i < difference.values.size(); ++i)
      difference.values[i] = std::max(difference.values[i], std::abs(t.values[i] - r.values[i]));
  }
  for (double& value : difference.values)
    value = std::clamp(std::pow(value / std::numbers::sqrt2, kFeatureExponent), 0.0, 1.0);
  return difference;
}

}  // namespace

Plane flip_map(const Planes& test, const Planes& reference, double pixels_per_degree) {
  const Planes t = opponent_planes(test);
  const Planes r = opponent_planes(reference);
  const Plane features = feature_difference(t[0], r[0], pixels_per_degree);
  Plane map = color_difference(t, r, pixels_per_degree);
  // Differences at edges and points are more visible.
  for (std::size_t i = 0; i < map.values.size(); ++i)
    map.values[i] = std::pow(std::clamp(map.values[i], 0.0, 1.0), 1 - features.values[i]);
  return map;
}

}  // namespace lightwell
