// How a splat's light falls off with the distance from its ray. The kernel declares kKernel.
#ifndef LIGHTWELL_PHOTON_SPLATTING_SPLAT_KERNEL_GLSL
#define LIGHTWELL_PHOTON_SPLATTING_SPLAT_KERNEL_GLSL

#include "shaders/constants.glsl"
#include "techniques/photon_splatting/splat_view_types.h"

// Weight at `across`, half widths from the axis. Its integral over the plane across the ray is `kernel_area`.
float kernel_weight(vec2 across) {
  float squared = dot(across, across);
  if (kKernel == kSplatTent) return max(0.0, 1.0 - sqrt(squared));
  if (kKernel == kSplatGaussian) return squared < 1.0 ? exp(-2.0 * squared) : 0.0;
  return all(lessThan(abs(across), vec2(1.0))) ? 1.0 : 0.0;
}

// Half widths squared.
float kernel_area() {
  if (kKernel == kSplatTent) return kPi / 3.0;
  if (kKernel == kSplatGaussian) return 0.5 * kPi * (1.0 - exp(-2.0));
  return 4.0;
}

#endif
