#pragma once

#include "core/plane.h"

namespace lightwell {

// Structural similarity of two gray images with values in [0,1], at every pixel (Wang et al. 2004, Eq. 13): 11x11
// Gaussian window with sigma 1.5, K1 = 0.01, K2 = 0.03, images mirrored at their borders.
Plane ssim_map(const Plane& a, const Plane& b);

}  // namespace lightwell
