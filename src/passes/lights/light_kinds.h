// Kinds of light on the way to a visible surface: who brings which of them is a set of these.
#pragma once

#include <cstdint>

namespace lightwell {

enum class LightKinds : std::uint8_t {
  kNone = 0,
  kLights = 1,       // straight from point, spot and directional lights
  kEmitters = 2,     // straight from emissive surfaces
  kEnvironment = 4,  // straight from the environment
  kBounced = 8,      // that met at least one surface on the way
  kAll = 15
};

constexpr LightKinds operator|(LightKinds a, LightKinds b) {
  return static_cast<LightKinds>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

// Those of `a` that are not in `b`.
constexpr LightKinds operator-(LightKinds a, LightKinds b) {
  return static_cast<LightKinds>(static_cast<unsigned>(a) & ~static_cast<unsigned>(b));
}

constexpr bool has(LightKinds kinds, LightKinds wanted) {
  return (static_cast<unsigned>(kinds) & static_cast<unsigned>(wanted)) != 0;
}

}  // namespace lightwell
