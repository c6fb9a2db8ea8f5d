// Indirect light as the path tracer sees it, with its own noise, and how far a picture is from it.
#pragma once

#include <vector>

#include <glm/ext/vector_int2.hpp>

#include "apps/cli/render_methods.h"
#include "lightwell/image.h"
#include "lightwell/metrics.h"
#include "lightwell/scene.h"

namespace lightwell {

// Errors without what the truth's own noise adds to them; 0 where it explains them all.
struct IndirectError {
  double rmse8 = 0.0;
  double rel_mse = 0.0;
  double energy = 0.0;
  double factor = 1.0;  // that the picture was multiplied by
};

// Pixels count where the picture of the truth has neither an edge nor a corner: there, light is compared and not
// anti-aliasing. RMSE is taken at the exposure that makes the mean of indirect light middle grey, 0.18; relMSE divides
// by r^2 + (m / 10)^2 with that mean m.
class IndirectTruth {
 public:
  // `samples` paths a pixel (at least 2), half of them each in two pictures that know nothing of each other. Throws
  // InputError where no pixel counts, or none has indirect light.
  IndirectTruth(const Scene& scene, const Moment& moment, const glm::ivec2& size, int samples, int bounces);

  // `fit`: what is measured is multiplied first by the one factor that makes the squares of differences least.
  IndirectError judge(Image indirect, bool fit) const;

  long pixels() const { return pixels_; }  // that count
  float exposure() const { return options_.exposure; }
  double mean() const { return mean_; }  // W/(sr m^2)
  double seconds() const { return seconds_; }
  int samples() const { return samples_; }
  // Of the truth.
  double noise_rmse8() const { return noise_.rmse8; }
  double noise_rel_mse() const { return noise_.rel_mse; }

 private:
  Image indirect_, mask_;
  MetricOptions options_;  // without mask
  Metrics noise_;
  int samples_ = 0;
  long pixels_ = 0;
  double mean_ = 0.0, seconds_ = 0.0;
};

}  // namespace lightwell
