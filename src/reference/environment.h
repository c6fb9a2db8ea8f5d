// Light from outside the scene: a constant or a latitude-longitude map (see Environment in lightwell/scene.h).
#pragma once

#include <vector>

#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>

#include "lightwell/scene.h"
#include "reference/sampling.h"

namespace lightwell {

// Directions are sampled in proportion to the map's mean luminance in each texel (Pharr, Jakob and Humphreys 2016,
// Sec. 14.2.4). A constant environment is not sampled: cosine sampling is already the best one for it.
class EnvironmentLight {
 public:
  struct Sample {
    glm::vec3 direction;
    float density;  // per steradian
    glm::vec2 uv;   // in the map
  };

  // `environment` must outlive this.
  explicit EnvironmentLight(const Environment& environment);

  bool is_black() const { return black_; }
  bool has_sampling() const { return rows_.total() > 0.0; }

  // W/(sr m^2) from unit `direction`; bilinear between texels.
  glm::vec3 radiance(const glm::vec3& direction) const;
  // Needs has_sampling().
  Sample sample(glm::vec2 u) const;
  // W/(sr m^2) from a sample's direction.
  glm::vec3 radiance(const Sample& sample) const { return radiance_at(sample.uv); }
  // Density with which sample() chooses `direction`, 0 without sampling.
  float density(const glm::vec3& direction) const;

 private:
  glm::vec3 texel(int x, int y) const;
  glm::vec3 radiance_at(glm::vec2 uv) const;
  float mean_luminance(int x, int y) const;
  float density_at(int x, int y, float sin_theta) const;

  const Environment& environment_;
  bool black_ = true;
  DiscreteDistribution rows_;
  std::vector<DiscreteDistribution> columns_;  // one a row
};

}  // namespace lightwell
