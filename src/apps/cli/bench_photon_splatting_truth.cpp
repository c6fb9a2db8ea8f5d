#include "apps/cli/bench_photon_splatting_truth.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lightwell/error.h"
#include "lightwell/path_tracer.h"

namespace lightwell {

namespace {

constexpr float kMiddleGrey = 0.18f;
constexpr double kDarkPart = 0.1;  // of the mean, below which relMSE no longer asks for relative exactness

void average(Image& a, const Image& b) {
  std::transform(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), a.pixels.begin(),
                 [](float x, float y) { return 0.5f * (x + y); });
}

glm::vec3 color(const Image& image, int x, int y) {
  const float* pixel = image.at(x, y);
  return {pixel[0], pixel[1], pixel[2]};
}

// Whether one flat or gently curved surface of one colour is around the pixel. A surface's 1 / depth is linear in the
// picture where it is flat.
bool is_plain(const Picture& picture, int x, int y) {
  const glm::vec3 normal = color(picture.normal, x, y), albedo = color(picture.albedo, x, y);
  const float depth = picture.depth.at(x, y)[0];
  if (!(depth > 0.0f) || !(glm::length(normal) > 0.999f)) return false;
  for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
    float bend = -2.0f / depth;
    for (const int side : {-1, 1}) {
      const int u = x + side * step.x, v = y + side * step.y;
      if (!(picture.depth.at(u, v)[0] > 0.0f)) return false;
      if (!(glm::dot(color(picture.normal, u, v), normal) > 0.98f)) return false;
      if (!(glm::distance(color(picture.albedo, u, v), albedo) < 0.02f)) return false;
      bend += 1.0f / picture.depth.at(u, v)[0];
    }
    if (!(std::abs(bend * depth) < 0.01f)) return false;
  }
  return true;
}

Image plain_pixels(const Picture& picture) {
  Image mask(picture.depth.width, picture.depth.height, 1);
  for (int y = 1; y + 1 < mask.height; ++y)
    for (int x = 1; x + 1 < mask.width; ++x) mask.at(x, y)[0] = is_plain(picture, x, y) ? 1.0f : 0.0f;
  return mask;
}

double without_noise(double error, double noise) {
  return std::sqrt(std::max(error * error - noise * noise, 0.0));
}

}  // namespace

// With halves a and b and their mean r, the mean square of a - r is that of (a - b) / 2, which is expected to be the
// variance of r.
IndirectTruth::IndirectTruth(const Scene& scene, const Moment& moment, const glm::ivec2& size, int samples, int bounces)
    : samples_(2 * (samples / 2)) {
  const auto start = std::chrono::steady_clock::now();
  PathTracerOptions options{.width = size.x, .height = size.y, .samples = samples_ / 2, .max_bounces = bounces};
  const PathTracer tracer(scene, moment.world);
  Picture first = tracer.render(moment.camera, options);
  options.seed = 2;
  const Picture second = tracer.render(moment.camera, options);
  mask_ = plain_pixels(first);
  indirect_ = first.indirect;
  average(indirect_, second.indirect);
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  if (std::count(mask_.pixels.begin(), mask_.pixels.end(), 1.0f) == 0)
    throw InputError("--size", "no pixel is away from edges; a larger picture has some");
  MetricOptions masked;
  masked.mask = &mask_;
  mean_ = compute_metrics(indirect_, indirect_, masked).mean_reference;
  if (!(mean_ > 0.0)) throw InputError("--scenes", "no indirect light is seen");
  masked.exposure = kMiddleGrey / static_cast<float>(mean_);
  masked.epsilon = kDarkPart * kDarkPart * mean_ * mean_;
  noise_ = compute_metrics(first.indirect, indirect_, masked);
  pixels_ = noise_.pixels;
  options_ = masked;
  options_.mask = nullptr;
}

IndirectError IndirectTruth::judge(Image indirect, bool fit) const {
  IndirectError error;
  if (fit) {
    double products = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < indirect.pixels.size(); ++i) {
      if (mask_.pixels[i / 3] < 0.5f) continue;
      products += static_cast<double>(indirect.pixels[i]) * indirect_.pixels[i];
      squares += static_cast<double>(indirect.pixels[i]) * indirect.pixels[i];
    }
    error.factor = squares > 0.0 ? products / squares : 1.0;
    for (float& value : indirect.pixels) value *= static_cast<float>(error.factor);
  }
  MetricOptions options = options_;
  options.mask = &mask_;
  const Metrics metrics = compute_metrics(indirect, indirect_, options);
  error.rmse8 = without_noise(metrics.rmse8, noise_.rmse8);
  error.rel_mse = std::max(metrics.rel_mse - noise_.rel_mse, 0.0);
  error.energy = metrics.energy;
  return error;
}

}  // namespace lightwell
