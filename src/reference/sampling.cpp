#include "reference/sampling.h"

#include <algorithm>
#include <cmath>

#include "lightwell/error.h"

namespace lightwell {
namespace {

constexpr std::size_t kWeightsPerPart = 8;  // a cache line of sums

}  // namespace

glm::vec2 sample_disk(glm::vec2 u) {
  const glm::vec2 p{2.0f * u.x - 1.0f, 2.0f * u.y - 1.0f};
  if (p.x == 0.0f && p.y == 0.0f) return {0.0f, 0.0f};
  // Concentric squares become concentric circles, one of four wedges at a time.
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float radius = wide ? p.x : p.y;
  const float angle = wide ? kPi / 4.0f * (p.y / p.x) : kPi / 2.0f - kPi / 4.0f * (p.x / p.y);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

glm::vec3 sample_cosine_hemisphere(glm::vec2 u) {
  const glm::vec2 p = sample_disk(u);
  return {p.x, p.y, std::sqrt(std::max(0.0f, 1.0f - p.x * p.x - p.y * p.y))};
}

glm::vec2 sample_triangle(glm::vec2 u) {
  const float root = std::sqrt(u.x);
  return {root * (1.0f - u.y), root * u.y};
}

glm::mat3 make_frame(const glm::vec3& z) {
  const float sign = std::copysign(1.0f, z.z);
  const float a = -1.0f / (sign + z.z);
  const float b = z.x * z.y * a;
  return {glm::vec3{1.0f + sign * z.x * z.x * a, sign * b, -sign * z.x}, glm::vec3{b, sign + z.y * z.y * a, -z.y}, z};
}

float power_heuristic(float chosen, float other) {
  // Divided by the larger one, so that densities of tiny far lights do not overflow.
  if (chosen <= 0.0f) return 0.0f;
  const float ratio = other / chosen;
  return 1.0f / (1.0f + ratio * ratio);
}

DiscreteDistribution::DiscreteDistribution(std::span<const float> weights) : cumulative_(weights.size()) {
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += static_cast<double>(weights[i]);
    cumulative_[i] = sum;
  }
  if (!(sum > 0.0)) return;
  const std::size_t parts = (weights.size() + kWeightsPerPart - 1) / kWeightsPerPart;
  cutpoints_.reserve(parts + 1);
  std::size_t index = 0;
  for (std::size_t part = 0; part <= parts; ++part) {
    const double begin = sum * static_cast<double>(part) / static_cast<double>(parts);
    while (index + 1 < cumulative_.size() && cumulative_[index] <= begin) ++index;
    cutpoints_.push_back(static_cast<std::uint32_t>(index));
  }
}

float DiscreteDistribution::probability(std::size_t index) const {
  const double below = index == 0 ? 0.0 : cumulative_[index - 1];
  return total() > 0.0 ? static_cast<float>((cumulative_[index] - below) / total()) : 0.0f;
}

DiscreteDistribution::Choice DiscreteDistribution::sample(float u) const {
  LW_ASSERT(total() > 0.0, "nothing to choose from");
  const double target = static_cast<double>(u) * total();
  const auto part = static_cast<std::size_t>(static_cast<double>(u) * static_cast<double>(cutpoints_.size() - 1));
  // The first interval that ends beyond the target: it cannot be an empty one.
  const auto end =
      std::upper_bound(cumulative_.begin() + cutpoints_[part], cumulative_.begin() + cutpoints_[part + 1], target);
  const auto index = static_cast<std::size_t>(end - cumulative_.begin());
  const double below = index == 0 ? 0.0 : cumulative_[index - 1];
  const double inside = (target - below) / (cumulative_[index] - below);
  return {index, probability(index), static_cast<float>(std::clamp(inside, 0.0, 0.99999994))};
}

}  // namespace lightwell
