// Warps from the unit square to what light transport integrates over, each with its density. Tested by chi-square.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <glm/ext/matrix_float3x3.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>

namespace lightwell {

inline constexpr float kPi = std::numbers::pi_v<float>;

// Area-preserving map of the square to the unit disk (Shirley and Chiu 1997). Density 1 / pi.
glm::vec2 sample_disk(glm::vec2 u);

// Unit vector about +Z with density cos / pi: a point of the disk lifted to the hemisphere (Malley's method).
glm::vec3 sample_cosine_hemisphere(glm::vec2 u);

// Barycentric weights of the second and third corner, uniform over any triangle's area (Turk 1990).
glm::vec2 sample_triangle(glm::vec2 u);

// Right-handed orthonormal frame whose third column is the unit vector `z` (Duff et al. 2017).
glm::mat3 make_frame(const glm::vec3& z);

// Weight of a sample with density `chosen` (per steradian) when another strategy could have made it with density
// `other`: the power heuristic with exponent 2 (Veach 1997, Eq. 9.13, n = 1).
float power_heuristic(float chosen, float other);

// Chooses an index with probability proportional to its weight by inversion, which keeps the stratification of u. Where
// to search is narrowed by a table (the cutpoint method, Chen and Asau 1974).
class DiscreteDistribution {
 public:
  struct Choice {
    std::size_t index = 0;
    float probability = 0.0f;
    float remainder = 0.0f;  // in [0, 1), uniform given the index: where in the index's interval u fell
  };

  DiscreteDistribution() = default;
  // Weights are finite and >= 0.
  explicit DiscreteDistribution(std::span<const float> weights);

  double total() const { return cumulative_.empty() ? 0.0 : cumulative_.back(); }
  float probability(std::size_t index) const;
  // total() > 0, u in [0, 1).
  Choice sample(float u) const;

 private:
  std::vector<double> cumulative_;
  // Where each of equal parts of [0, total()) begins, and the end.
  std::vector<std::uint32_t> cutpoints_;
};

}  // namespace lightwell
