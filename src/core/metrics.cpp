#include "lightwell/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/color.h"
#include "core/flip.h"
#include "core/luminance.h"
#include "core/plane.h"
#include "core/ssim.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

// Both images and which of their pixels count.
struct Comparison {
  Planes test, reference;
  std::vector<bool> counts;
  Planes variance{};  // of the reference; without values: not known
};

std::string size_text(const Image& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

void check_sizes(const Image& test, const Image& reference, const MetricOptions& options) {
  LW_ASSERT(test.channels == 3 && reference.channels == 3,
            std::to_string(test.channels) + ", " + std::to_string(reference.channels) + " channels");
  if (test.width != reference.width || test.height != reference.height)
    throw InputError("compare", "images differ in size: " + size_text(test) + " and " + size_text(reference));
  if (options.mask && (options.mask->width != test.width || options.mask->height != test.height))
    throw InputError("compare", "mask of " + size_text(*options.mask) + " for images of " + size_text(test));
  if (options.variance && (options.variance->channels != 3 || options.variance->width != test.width ||
                           options.variance->height != test.height))
    throw InputError("compare", "variance of " + size_text(*options.variance) + " with " +
                                    std::to_string(options.variance->channels) + " channels for images of " +
                                    size_text(test));
  if (options.block < 1 || options.block > std::min(test.width, test.height))
    throw InputError("compare",
                     "blocks of " + std::to_string(options.block) + " pixels in images of " + size_text(test));
}

Planes split(const Image& image) {
  Planes planes;
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c] = Plane(image.width, image.height);
    for (std::size_t i = 0; i < planes[c].values.size(); ++i) planes[c].values[i] = image.pixels[i * 3 + c];
  }
  return planes;
}

// Sets what is not finite to 0; returns in how many pixels.
long remove_bad_pixels(Planes& planes) {
  long bad = 0;
  for (std::size_t i = 0; i < planes[0].values.size(); ++i) {
    bool finite = true;
    for (Plane& plane : planes) {
      if (std::isfinite(plane.values[i])) continue;
      plane.values[i] = 0;
      finite = false;
    }
    if (!finite) ++bad;
  }
  return bad;
}

Planes read_variance(const Image& image) {
  const bool valid = std::all_of(image.pixels.begin(), image.pixels.end(),
                                 [](float value) { return value >= 0.0f && std::isfinite(value); });
  if (!valid) throw InputError("compare", "the variance holds pixels that are negative, NaN or infinite");
  return split(image);
}

std::vector<bool> read_mask(const Image* mask, std::size_t pixels) {
  std::vector<bool> counts(pixels, true);
  if (!mask) return counts;
  for (std::size_t i = 0; i < pixels; ++i)
    counts[i] = mask->pixels[i * static_cast<std::size_t>(mask->channels)] > 0.5f;
  return counts;
}

// Means of block x block pixels; what is left over at the right and below is dropped.
Plane block_means(const Plane& plane, int block) {
  Plane means(plane.width / block, plane.height / block);
  for (int y = 0; y < means.height * block; ++y)
    for (int x = 0; x < means.width * block; ++x) means.at(x / block, y / block) += plane.at(x, y);
  for (double& value : means.values) value /= static_cast<double>(block) * block;
  return means;
}

// Averages the pixels that count within each block; a block counts where more than a quarter of its pixels do.
void average_blocks(Comparison& comparison, int block) {
  const Plane& any = comparison.test[0];
  Plane mask(any.width, any.height);
  for (std::size_t i = 0; i < mask.values.size(); ++i) mask.values[i] = comparison.counts[i] ? 1 : 0;
  const Plane coverage = block_means(mask, block);
  for (Planes* planes : {&comparison.test, &comparison.reference})
    for (Plane& plane : *planes) {
      for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] *= mask.values[i];
      plane = block_means(plane, block);
      for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] /= std::max(coverage.values[i], 1e-9);
    }
  // Of a mean of n independent pixels: the sum of their variances over n^2.
  for (Plane& plane : comparison.variance) {
    if (plane.values.empty()) continue;
    for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] *= mask.values[i];
    plane = block_means(plane, block);
    for (std::size_t i = 0; i < plane.values.size(); ++i)
      plane.values[i] /= std::max(coverage.values[i] * coverage.values[i], 1e-9) * block * block;
  }
  comparison.counts.assign(coverage.values.size(), false);
  for (std::size_t i = 0; i < coverage.values.size(); ++i) comparison.counts[i] = coverage.values[i] > 0.25;
}

double ratio(double a, double b) {
  if (b > 0) return a / b;
  return a == 0 ? 1.0 : std::numeric_limits<double>::infinity();
}

// The q-th quantile, linear between the two values beside it.
double quantile(std::vector<double> values, double q) {
  const double position = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(position);
  std::nth_element(values.begin(), values.begin() + below, values.end());
  const double low = values[static_cast<std::size_t>(below)];
  if (static_cast<std::size_t>(below) + 1 == values.size()) return low;
  const double high = *std::min_element(values.begin() + below + 1, values.end());
  return low + (high - low) * (position - static_cast<double>(below));
}

// Everything that is linear in radiance.
void measure_radiance(const Comparison& comparison, double epsilon, Metrics& metrics) {
  std::vector<double> absolute;
  absolute.reserve(static_cast<std::size_t>(metrics.pixels) * 3);
  double relative = 0, test_sum[3] = {}, reference_sum[3] = {};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < comparison.counts.size(); ++i) {
      if (!comparison.counts[i]) continue;
      const double t = comparison.test[c].values[i], r = comparison.reference[c].values[i];
      relative += (t - r) * (t - r) / (r * r + epsilon);
      absolute.push_back(std::abs(t - r));
      test_sum[c] += t;
      reference_sum[c] += r;
    }
  const auto samples = static_cast<double>(absolute.size());
  metrics.rel_mse = relative / samples;
  metrics.mean_test = (test_sum[0] + test_sum[1] + test_sum[2]) / samples;
  metrics.mean_reference = (reference_sum[0] + reference_sum[1] + reference_sum[2]) / samples;
  metrics.energy = ratio(metrics.mean_test, metrics.mean_reference);
  for (std::size_t c = 0; c < 3; ++c) metrics.energy_rgb[c] = ratio(test_sum[c], reference_sum[c]);
  metrics.max_abs = *std::max_element(absolute.begin(), absolute.end());
  metrics.p99_abs = quantile(std::move(absolute), 0.99);
}

// Per pixel, the mean over channels of ((t - r)^2 - variance) / (t^2 + epsilon): its expected value is 0 where only the
// reference's noise differs, as the divisor does not depend on that. Channels of a pixel share their paths: their
// deviations are added as if they always went together.
void measure_noise(const Comparison& comparison, double epsilon, Metrics& metrics) {
  double explained = 0, total = 0, rest = 0, squares = 0, sum_variance = 0;
  for (std::size_t i = 0; i < comparison.counts.size(); ++i) {
    if (!comparison.counts[i]) continue;
    double excess = 0, deviation = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double t = comparison.test[c].values[i], variance = comparison.variance[c].values[i];
      const double square = (t - comparison.reference[c].values[i]) * (t - comparison.reference[c].values[i]);
      explained += variance / (t * t + epsilon) / 3;
      total += square / (t * t + epsilon) / 3;
      excess += (square - variance) / (t * t + epsilon) / 3;
      deviation += std::sqrt(variance) / 3;
    }
    rest += excess;
    squares += excess * excess;
    sum_variance += deviation * deviation;
  }
  constexpr double kSignificant = 3.0;
  const auto pixels = static_cast<double>(metrics.pixels);
  NoiseMetrics& noise = metrics.noise;
  const auto in_sigmas = [](double value, double sigma) {
    if (sigma > 0) return value / sigma;
    return value == 0 ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), value);
  };
  noise.rel_mse = explained / pixels;
  noise.rest = rest / pixels;
  noise.part = total > explained ? explained / total : 1.0;
  const double spread = std::max(0.0, squares / pixels - noise.rest * noise.rest);
  noise.rest_sigmas = in_sigmas(noise.rest, std::sqrt(spread / std::max(1.0, pixels - 1)));
  const double sigma = std::sqrt(sum_variance) / pixels;  // of mean_reference
  noise.energy_sigma = ratio(sigma, metrics.mean_reference) * metrics.energy;
  noise.energy_sigmas = in_sigmas(metrics.mean_test - metrics.mean_reference, sigma);
  noise.significant = noise.rest_sigmas > kSignificant || std::abs(noise.energy_sigmas) > kSignificant;
}

// Sum over channels of the RMSE of 8-bit codes, as the earliest papers on real-time GI give it.
double rmse_of_codes(const Planes& test, const Planes& reference, const std::vector<bool>& counts, long pixels) {
  double total = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (!counts[i]) continue;
      const double difference = std::nearbyint(test[c].values[i] * 255) - std::nearbyint(reference[c].values[i] * 255);
      sum += difference * difference;
    }
    total += std::sqrt(sum / static_cast<double>(pixels));
  }
  return total;
}

template <typename Function>
Planes map_values(const Planes& planes, Function function) {
  Planes mapped = planes;
  for (Plane& plane : mapped)
    for (double& value : plane.values) value = function(value);
  return mapped;
}

Plane luma(const Planes& display) {
  Plane result(display[0].width, display[0].height);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = luminance(glm::dvec3(display[0].values[i], display[1].values[i], display[2].values[i]));
  return result;
}

double mean_where(const Plane& plane, const std::vector<bool>& counts, long pixels) {
  double sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i]) sum += plane.values[i];
  return sum / static_cast<double>(pixels);
}

// Everything that is seen on a display.
void measure_display(const Comparison& comparison, double exposure, Metrics& metrics) {
  const auto clipped = [=](double x) { return srgb_from_linear(std::clamp(x * exposure, 0.0, 1.0)); };
  metrics.rmse8 = rmse_of_codes(map_values(comparison.test, clipped), map_values(comparison.reference, clipped),
                                comparison.counts, metrics.pixels);
  const auto tone_mapped = [=](double x) { return display_value(x, exposure); };
  const Planes test = map_values(comparison.test, tone_mapped);
  const Planes reference = map_values(comparison.reference, tone_mapped);
  metrics.rmse8_tone_mapped = rmse_of_codes(test, reference, comparison.counts, metrics.pixels);
  metrics.ssim = mean_where(ssim_map(luma(test), luma(reference)), comparison.counts, metrics.pixels);
  metrics.flip = mean_where(flip_map(test, reference), comparison.counts, metrics.pixels);
}

}  // namespace

Metrics compute_metrics(const Image& test, const Image& reference, const MetricOptions& options) {
  check_sizes(test, reference, options);
  Metrics metrics;
  Comparison comparison{split(test), split(reference), {}};
  metrics.bad_pixels = remove_bad_pixels(comparison.test);
  if (remove_bad_pixels(comparison.reference) > 0)
    throw InputError("compare", "the reference holds pixels that are NaN or infinite");
  if (options.variance) comparison.variance = read_variance(*options.variance);
  comparison.counts = read_mask(options.mask, comparison.test[0].values.size());
  if (options.block > 1) average_blocks(comparison, options.block);
  metrics.pixels = static_cast<long>(std::count(comparison.counts.begin(), comparison.counts.end(), true));
  if (metrics.pixels == 0) throw InputError("compare", "the mask leaves no pixel");
  measure_radiance(comparison, options.epsilon, metrics);
  if (options.variance) measure_noise(comparison, options.epsilon, metrics);
  measure_display(comparison, options.exposure, metrics);
  return metrics;
}

}  // namespace lightwell
