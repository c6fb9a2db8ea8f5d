#pragma once

#include <numbers>

#include "core/plane.h"

namespace lightwell {

// A 0.7 m wide display of 3840 pixels seen from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 0.7 * 3840 / 0.7 * std::numbers::pi / 180;

// Difference in [0,1] that an eye sees at each pixel when two images alternate: LDR FLIP (Andersson et al. 2020) of
// sRGB encoded images with values in [0,1].
Plane flip_map(const Planes& test, const Planes& reference, double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace lightwell
