// From samples to pixels of a Picture.
#pragma once

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

// All images of a picture, black.
Picture make_picture(int width, int height);

// The mean of `samples` samples.
void store(Picture& picture, int x, int y, const PixelSum& sum, int samples);

}  // namespace lightwell
