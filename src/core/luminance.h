// How bright a colour looks.
#pragma once

#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_float3.hpp>

namespace lightwell {

// Linear sRGB primaries (ITU-R BT.709). In GLSL: shaders/luminance.glsl.
template <class T>
T luminance(const glm::vec<3, T>& c) {
  return T(0.2126) * c.r + T(0.7152) * c.g + T(0.0722) * c.b;
}

}  // namespace lightwell
