#include "core/color_space.h"

#include <cmath>

#include <glm/ext/matrix_double3x3.hpp>
#include <glm/matrix.hpp>

namespace lightwell {

namespace {

// CIE XYZ of the sRGB primaries (IEC 61966-2-1), one column each.
const glm::dmat3 kXyzFromRgb(0.4123908, 0.2126390, 0.0193308,   // red
                             0.3575843, 0.7151687, 0.1191948,   // green
                             0.1804808, 0.0721923, 0.9505322);  // blue
const glm::dmat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);
const glm::dvec3 kWhite = kXyzFromRgb * glm::dvec3(1.0);

constexpr double kDelta = 6.0 / 29.0;  // where the cube root gives way to a line

double lab_curve(double t) {
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
}

double inverse_lab_curve(double f) {
  return f > kDelta ? f * f * f : 3 * kDelta * kDelta * (f - 4.0 / 29.0);
}

glm::dvec3 opponents(const glm::dvec3& f) {
  return {116 * f.y - 16, 500 * (f.x - f.y), 200 * (f.y - f.z)};
}

glm::dvec3 inverse_opponents(const glm::dvec3& o) {
  const double y = (o.x + 16) / 116;
  return {y + o.y / 500, y, y - o.z / 200};
}

}  // namespace

glm::dvec3 lab_from_rgb(const glm::dvec3& linear_rgb) {
  const glm::dvec3 xyz = kXyzFromRgb * linear_rgb / kWhite;
  return opponents({lab_curve(xyz.x), lab_curve(xyz.y), lab_curve(xyz.z)});
}

glm::dvec3 rgb_from_lab(const glm::dvec3& lab) {
  const glm::dvec3 f = inverse_opponents(lab);
  const glm::dvec3 xyz(inverse_lab_curve(f.x), inverse_lab_curve(f.y), inverse_lab_curve(f.z));
  return kRgbFromXyz * (xyz * kWhite);
}

glm::dvec3 ycxcz_from_rgb(const glm::dvec3& linear_rgb) {
  return opponents(kXyzFromRgb * linear_rgb / kWhite);
}

glm::dvec3 rgb_from_ycxcz(const glm::dvec3& ycxcz) {
  return kRgbFromXyz * (inverse_opponents(ycxcz) * kWhite);
}

}  // namespace lightwell
