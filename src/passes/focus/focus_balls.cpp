#include "passes/focus/focus_balls.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lightwell {
namespace {

constexpr float kRatio = 4.0f;   // of the radii of balls that follow each other
constexpr float kStep = 0.2f;    // of a radius
constexpr float kStays = 0.75f;  // of a step; half of one would be the nearest centre
constexpr float kLargestPart =
    1.0f / 6.0f;                      // of the scene, a radius: the scene's own view may have twice the texels a side
constexpr float kMuchSmaller = 0.7f;  // than the scene

float diagonal_of(const Bounds& bounds) {
  return glm::length(bounds.maximum - bounds.minimum);
}

glm::vec3 middle_of(const Bounds& bounds) {
  return bounds.minimum + 0.5f * (bounds.maximum - bounds.minimum);
}

glm::vec3 snap(const glm::vec3& focus, float radius, const FocusBall* last) {
  const float step = kStep * radius;
  if (last && last->radius == radius) {
    const glm::vec3 away = glm::abs(focus - last->center);
    if (std::max({away.x, away.y, away.z}) <= kStays * step) return last->center;
  }
  return glm::round(focus / step) * step;
}

}  // namespace

std::vector<FocusBall> make_focus_balls(const Bounds& bounds, const glm::vec3& focus,
                                        const std::optional<Bounds>& region, std::span<const FocusBall> last) {
  const float diagonal = diagonal_of(bounds);
  if (!std::isfinite(diagonal)) return {};
  const float region_radius = region ? 0.5f * diagonal_of(*region) : 0.0f;
  const bool has_region = region && region_radius <= std::min(kLargestFocus, 0.5f * kMuchSmaller * diagonal);
  if (!has_region && !(diagonal > kSmallScene)) return {};

  const float finest = has_region ? std::max(region_radius, 1e-4f * diagonal) : kFinestFocus;
  const float octaves = std::log2(0.5f * diagonal / finest);
  const float wanted = std::ceil(octaves / std::log2(kRatio) - 1e-3f);
  const auto count = static_cast<std::uint32_t>(std::clamp(wanted, 1.0f, static_cast<float>(kMostFocusBalls)));
  // Of scenes that the balls would not fill, in steps, so that centres stay while bounds change.
  const float ratio = std::max(kRatio, std::exp2(std::ceil(octaves / static_cast<float>(count) * 4.0f) / 4.0f));

  const glm::vec3 place = has_region ? middle_of(*region) : glm::clamp(focus, bounds.minimum, bounds.maximum);
  std::vector<FocusBall> balls;
  float radius = finest;
  for (std::uint32_t i = 0; i < count && (i == 0 || radius < kLargestPart * diagonal); ++i, radius *= ratio)
    balls.push_back({has_region ? place : snap(place, radius, i < last.size() ? &last[i] : nullptr), radius});
  return balls;
}

}  // namespace lightwell
