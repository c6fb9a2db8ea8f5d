// Where in the pixel the samples of an anti-aliased picture lie.
#pragma once

#include <cstdint>

#include <glm/ext/vector_float2.hpp>

namespace lightwell {

// Sample `index` of `count`, from the pixel's centre, in pixels: the Hammersley set, shifted so that its mean is the
// centre. One sample lies at the centre.
inline glm::vec2 sample_position(std::uint32_t index, std::uint32_t count) {
  float radical_inverse = 0.0f;  // base 2
  float digit = 0.5f;
  for (std::uint32_t i = index, n = 1; n < count; i /= 2, n *= 2, digit /= 2.0f) {
    radical_inverse += static_cast<float>(i % 2) * digit;
  }
  // `digit` is half of the set's spacing in y: of powers of two the mean becomes exactly 0.
  return {(static_cast<float>(index) + 0.5f) / static_cast<float>(count) - 0.5f, radical_inverse + digit - 0.5f};
}

}  // namespace lightwell
