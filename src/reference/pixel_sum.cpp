#include "reference/pixel_sum.h"

#include <glm/geometric.hpp>

namespace lightwell {

void store(Image& image, int x, int y, const glm::dvec3& value) {
  for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<float>(value[c]);
}

void PixelSum::add(const PathSample& sample, const WorldCamera& camera) {
  direct += sample.direct;
  indirect += sample.indirect;
  emission += sample.emission;
  if (!sample.hit) return;
  albedo += sample.albedo;
  normal += sample.normal;
  depth += glm::dot(glm::dvec3{sample.position} - glm::dvec3{camera.position}, glm::dvec3{camera.forward});
  ++hits;
}

// A part of n_p samples has a mean m_p of variance s^2 / n_p, and sum(n_p (m_p - m)^2) / (parts - 1) is s^2 in the
// mean.
glm::dvec3 MeanVariance::value() const {
  glm::dvec3 total{0.0};
  double count = 0.0, parts = 0.0;
  for (const Sum& sum : sums_) {
    total += sum.value;
    count += sum.count;
    if (sum.count > 0.0) parts += 1.0;
  }
  if (parts < 2.0) return glm::dvec3{0.0};
  glm::dvec3 spread{0.0};
  for (const Sum& sum : sums_) {
    if (sum.count == 0.0) continue;
    const glm::dvec3 difference = sum.value / sum.count - total / count;
    spread += sum.count * difference * difference;
  }
  return spread / ((parts - 1.0) * count);
}

Picture make_picture(int width, int height) {
  Picture picture;
  for (Image* image :
       {&picture.combined, &picture.direct, &picture.indirect, &picture.emission, &picture.albedo, &picture.normal}) {
    *image = Image(width, height, 3);
  }
  picture.depth = Image(width, height, 1);
  return picture;
}

void store(Picture& picture, int x, int y, const PixelSum& sum, int samples) {
  const double scale = 1.0 / samples;
  store(picture.direct, x, y, sum.direct * scale);
  store(picture.indirect, x, y, sum.indirect * scale);
  store(picture.emission, x, y, sum.emission * scale);
  store(picture.combined, x, y, (sum.direct + sum.indirect + sum.emission) * scale);
  store(picture.albedo, x, y, sum.albedo * scale);
  store(picture.normal, x, y, sum.normal * scale);
  // The mean over what is seen: a mean with the background's 0 would be a depth where nothing is.
  *picture.depth.at(x, y) = sum.hits > 0 ? static_cast<float>(sum.depth / sum.hits) : 0.0f;
}

}  // namespace lightwell
