// What matters most of a large scene: balls about the point where it is looked at, each within the next.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/ext/vector_float3.hpp>

#include "lightwell/scene.h"

namespace lightwell {

struct FocusBall {
  glm::vec3 center{0.0f};
  float radius = 0.0f;  // m
  bool operator==(const FocusBall&) const = default;
};

inline constexpr float kSmallScene = 60.0f;    // m; scenes with no longer a diagonal are covered as a whole
inline constexpr float kFinestFocus = 10.0f;   // m, radius
inline constexpr float kLargestFocus = 30.0f;  // m, radius of the finest ball that `region` may ask for
inline constexpr std::uint32_t kMostFocusBalls = 5;

// Finest first, each about four times as wide as the one before, up to a third of the scene. None in scenes that are
// small or not finite.
//
// `focus`: m, moved into the scene where it is not. A ball's centre stays what it is in `last` until the focus is
// more than 0.15 of its radius away from it along an axis, and moves in steps of 0.2 of it: within 0.7 of the radius of
// the focus a ball holds everything. `region`: a part of the scene that the finest ball is to hold, wherever the focus
// is; without effect where it is larger than kLargestFocus, or not much smaller than the scene.
std::vector<FocusBall> make_focus_balls(const Bounds& bounds, const glm::vec3& focus,
                                        const std::optional<Bounds>& region, std::span<const FocusBall> last);

}  // namespace lightwell
