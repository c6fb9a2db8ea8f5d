// How far a picture is from the truth. Definitions: docs/results.md, "Metrics".
#pragma once

#include <string>

#include "lightwell/image.h"

namespace lightwell {

// sRGB transfer function of a linear value in [0,1] (IEC 61966-2-1).
float srgb_encode(float linear);
float srgb_decode(float encoded);

// Display transform of PNGs and of the tone-mapped metrics: sRGB(x / (1 + x)) with x = exposure * max(radiance, 0).
Image tone_map(const Image& radiance, float exposure);

struct MetricOptions {
  float exposure = 1.0f;            // multiplies radiance before any display transform
  int block = 1;                    // both images are averaged over block x block pixels first
  double epsilon = 1e-2;            // of relMSE
  const Image* mask = nullptr;      // pixels whose first channel is > 0.5 count; null: all
  const Image* variance = nullptr;  // of the reference's pixels, as Picture::variance; null: not known
};

// What the reference's own noise says about a difference. The test picture counts as if it had none.
struct NoiseMetrics {
  double rel_mse = 0;        // mean(variance / (t^2 + epsilon)): by t, which noise does not touch
  double part = 0;           // of mean((t-r)^2 / (t^2 + epsilon)) that this explains, in [0, 1]
  double rest = 0;           // that mean less rel_mse: below 0 by chance
  double rest_sigmas = 0;    // rest in its own standard deviations, from how it differs between pixels
  double energy_sigma = 0;   // standard deviation of Metrics::energy
  double energy_sigmas = 0;  // energy - 1 in those, sign and all
  bool significant = false;  // either is beyond 3 standard deviations: the pictures differ by more than noise
};

struct Metrics {
  long pixels = 0;               // that counted
  long bad_pixels = 0;           // NaN or infinite in the test image; taken as 0
  double rel_mse = 0;            // mean((t-r)^2 / (r^2 + epsilon)), linear, all channels
  double rmse8 = 0;              // sum over R,G,B of sqrt(mean((t-r)^2)) of round(255 * sRGB(clip(e*L)))
  double rmse8_tone_mapped = 0;  // the same after Reinhard instead of the clip
  double ssim = 0;               // Wang et al. 2004, 11x11 Gaussian, sigma 1.5, luma of the tone-mapped images
  double flip = 0;               // mean FLIP (Andersson et al. 2020) of the tone-mapped images, 67 pixels per degree
  double energy = 0;             // mean(t) / mean(r)
  double energy_rgb[3] = {0, 0, 0};
  double max_abs = 0;  // linear absolute error
  double p99_abs = 0;  // its 99th percentile
  double mean_test = 0;
  double mean_reference = 0;
  NoiseMetrics noise;  // with MetricOptions::variance
};

// Compares two 3-channel images of one size. Throws InputError if sizes differ, the mask leaves nothing, or a
// variance is negative or not finite.
Metrics compute_metrics(const Image& test, const Image& reference, const MetricOptions& options = {});

// Difference heat map: |t-r| of the tone-mapped images, summed over channels, x4, in a perceptually even colour map.
Image difference_heat_map(const Image& test, const Image& reference, float exposure);

}  // namespace lightwell
