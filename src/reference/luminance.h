// How bright a colour looks: what light sampling goes by.
#pragma once

#include <glm/ext/vector_float3.hpp>

namespace lightwell {

// Linear sRGB primaries (ITU-R BT.709).
inline float luminance(const glm::vec3& c) {
  return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

}  // namespace lightwell
