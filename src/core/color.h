// The sRGB transfer function and Reinhard's curve in double precision: metrics are computed with these.
#pragma once

#include <algorithm>
#include <cmath>

namespace lightwell {

// IEC 61966-2-1, linear to encoded.
inline double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

inline double linear_from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// Reinhard et al. 2002, Eq. 3, on each channel. Infinity maps to 1, its limit.
inline double reinhard(double x) {
  return std::isinf(x) ? 1.0 : x / (1.0 + x);
}

// What a display shows of a radiance, in [0,1].
inline double display_value(double radiance, double exposure) {
  return srgb_from_linear(reinhard(std::max(radiance, 0.0) * exposure));
}

}  // namespace lightwell
