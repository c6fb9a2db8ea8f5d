// From samples to pixels of a Picture.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/ext/vector_double3.hpp>

#include "lightwell/picture.h"
#include "lightwell/scene.h"
#include "reference/path_integrator.h"

namespace lightwell {

// Sums of one pixel's samples in double precision.
struct PixelSum {
  glm::dvec3 direct{0.0}, indirect{0.0}, emission{0.0}, albedo{0.0}, normal{0.0};
  double depth = 0.0;
  int hits = 0;

  void add(const PathSample& sample, const WorldCamera& camera);
};

// The samples of a pixel in parts that share no random numbers: within each they are spread evenly, and the spread of
// the parts' means is the variance of the mean of all.
class SampleParts {
 public:
  // One part, and no variance, where none is wanted: every part spreads its samples for itself, which is noisier.
  SampleParts(int samples, bool variance)
      : count_(!variance       ? 1
               : samples >= 16 ? 4
               : samples >= 2  ? 2
                               : 1),
        size_((samples + count_ - 1) / count_) {}

  int count() const { return count_; }
  int part(int sample) const { return sample / size_; }
  int index(int sample) const { return sample % size_; }

 private:
  int count_;
  int size_;
};

// Variance of a pixel's mean, per channel.
class MeanVariance {
 public:
  explicit MeanVariance(const SampleParts& parts) : sums_(static_cast<std::size_t>(parts.count())) {}
  void add(int part, const glm::dvec3& value) {
    sums_[static_cast<std::size_t>(part)].value += value;
    sums_[static_cast<std::size_t>(part)].count += 1.0;
  }
  // After the last sample; 0 with a single sample.
  glm::dvec3 value() const;

 private:
  struct Sum {
    glm::dvec3 value{0.0};
    double count = 0.0;
  };
  std::vector<Sum> sums_;
};

// All images of a picture but the variance, black.
Picture make_picture(int width, int height);

void store(Image& image, int x, int y, const glm::dvec3& value);

// The mean of `samples` samples.
void store(Picture& picture, int x, int y, const PixelSum& sum, int samples);

}  // namespace lightwell
