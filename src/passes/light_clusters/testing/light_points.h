// Light points for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include "lightwell/scene.h"
#include "shaders/light_point.h"

namespace lightwell {

inline std::uint32_t pack_unit_vector(const glm::vec3& v) {
  glm::vec2 p = glm::vec2(v) / (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
  if (v.z < 0.0f)
    p = {(1.0f - std::abs(p.y)) * (p.x < 0.0f ? -1.0f : 1.0f), (1.0f - std::abs(p.x)) * (p.y < 0.0f ? -1.0f : 1.0f)};
  return glm::packSnorm2x16(p);
}

inline glm::vec3 unpack_unit_vector(std::uint32_t packed) {
  const glm::vec2 p = glm::unpackSnorm2x16(packed);
  glm::vec3 v(p, 1.0f - std::abs(p.x) - std::abs(p.y));
  if (v.z < 0.0f) {
    v.x = (1.0f - std::abs(p.y)) * (p.x < 0.0f ? -1.0f : 1.0f);
    v.y = (1.0f - std::abs(p.x)) * (p.y < 0.0f ? -1.0f : 1.0f);
  }
  return glm::normalize(v);
}

// Spread over a box, normals any way, of very different power.
inline std::vector<glsl::LightPoint> random_light_points(std::uint32_t count, const Bounds& bounds,
                                                         std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::normal_distribution<float> normal;
  std::vector<glsl::LightPoint> points(count);
  for (glsl::LightPoint& point : points) {
    const glm::vec3 place(unit(random), unit(random), unit(random));
    point.position = glm::mix(bounds.minimum, bounds.maximum, place);
    const glm::vec3 direction(normal(random), normal(random), normal(random));
    point.normal = pack_unit_vector(glm::normalize(direction + glm::vec3(0.0f, 0.0f, 1e-6f)));
    const float power = std::pow(10.0f, -3.0f * unit(random));
    point.flux = power * glm::vec3(unit(random) + 0.01f, unit(random) + 0.01f, unit(random) + 0.01f);
    point.bounces = 1 + random() % 3;
  }
  return points;
}

}  // namespace lightwell
