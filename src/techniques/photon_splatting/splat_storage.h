// Splats in memory, as splat_storage.glsl has them. For tests only.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include "techniques/photon_splatting/shadow_atlas.h"
#include "techniques/photon_splatting/splat_types.h"

namespace lightwell {

// As shaders/light_point.glsl packs and unpacks unit vectors.
inline std::uint32_t pack_unit_vector(const glm::vec3& v) {
  const auto sign = [](float x) { return x < 0.0f ? -1.0f : 1.0f; };
  glm::vec2 p = glm::vec2(v) / (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
  if (v.z < 0.0f) p = (1.0f - glm::vec2(std::abs(p.y), std::abs(p.x))) * glm::vec2(sign(p.x), sign(p.y));
  return glm::packSnorm2x16(p);
}

inline glm::vec3 unpack_unit_vector(std::uint32_t packed) {
  const auto sign = [](float x) { return x < 0.0f ? -1.0f : 1.0f; };
  const glm::vec2 p = glm::unpackSnorm2x16(packed);
  glm::vec3 v(p, 1.0f - std::abs(p.x) - std::abs(p.y));
  if (v.z < 0.0f) v = {(1.0f - std::abs(p.y)) * sign(p.x), (1.0f - std::abs(p.x)) * sign(p.y), v.z};
  return glm::normalize(v);
}

// Lengths that are no positive numbers become 0, flux that is not finite too.
inline glsl::StoredSplat store_splat(const glsl::Splat& splat) {
  const auto positive = [](float x) { return std::isfinite(x) && x > 0.0f ? x : 0.0f; };
  const auto as_short = [&](float x, std::uint32_t up) {
    return (std::bit_cast<std::uint32_t>(positive(x)) + up) >> 15;
  };
  glsl::StoredSplat stored{.center = splat.center,
                           .direction = pack_unit_vector(splat.direction),
                           .normal = splat.normal,
                           .lengths = as_short(splat.half_width, 0x4000) | as_short(splat.reach, 0x7fff) << 16};
  const float most = std::max({positive(splat.flux.r), positive(splat.flux.g), positive(splat.flux.b)});
  int exponent = 0;
  std::frexp(most, &exponent);
  if (std::ldexp(most, 10 - exponent) > 1023.0f) ++exponent;
  for (int i = 0; i < 3; ++i) {
    const float scaled = std::ldexp(positive(splat.flux[i]), 10 - exponent);
    stored.colors |= static_cast<std::uint32_t>(std::lround(scaled)) << (10 * i);
  }
  std::uint32_t shift = 0;
  const auto photons = static_cast<std::uint32_t>(splat.photons);
  while (photons >> shift > 511) ++shift;
  const std::uint32_t count = photons < 256 ? photons : (shift + 1) << 8 | (photons >> shift & 255u);
  stored.parts = static_cast<std::uint32_t>(exponent + 126) |
                 static_cast<std::uint32_t>(std::lround(1024.0f * std::min(positive(splat.accepted), 1.0f))) << 8 |
                 count << 19;
  return stored;
}

inline glsl::Splat load_splat(const glsl::StoredSplat& stored, std::uint32_t index) {
  const auto as_float = [](std::uint32_t bits) { return std::bit_cast<float>((bits & 0xffffu) << 15); };
  const std::uint32_t count = stored.parts >> 19;
  const std::uint32_t exponent = count >> 8 & 15u;
  const std::uint32_t photons = exponent == 0 ? count & 255u : (256u | (count & 255u)) << (exponent - 1);
  const int unit = static_cast<int>(stored.parts & 255u) - 136;
  glm::vec3 flux;
  for (int i = 0; i < 3; ++i) flux[i] = std::ldexp(static_cast<float>(stored.colors >> (10 * i) & 1023u), unit);
  return {.center = stored.center,
          .half_width = as_float(stored.lengths),
          .direction = unpack_unit_vector(stored.direction),
          .reach = as_float(stored.lengths >> 16),
          .flux = flux,
          .photons = static_cast<float>(photons),
          .accepted = static_cast<float>(stored.parts >> 8 & 2047u) / 1024.0f,
          .map = index,
          .normal = stored.normal};
}

// The kernel's integral over a texel, in any unit, as shadow_atlas_finish.comp estimates it.
inline float texel_weight(SplatKernel kernel, std::uint32_t x, std::uint32_t y, std::uint32_t side) {
  const float off = 1.0f / (std::sqrt(3.0f) * static_cast<float>(side));
  float sum = 0.0f;
  for (int i = 0; i < 4; ++i) {
    const glm::vec2 middle = (2.0f * glm::vec2(x, y) + 1.0f) / static_cast<float>(side) - 1.0f;
    const float distance = glm::length(middle + glm::vec2(i % 2 == 0 ? -off : off, i < 2 ? -off : off));
    if (kernel == SplatKernel::kTent) sum += std::max(0.0f, 1.0f - distance);
    if (kernel == SplatKernel::kGaussian) sum += distance < 1.0f ? std::exp(-2.0f * distance * distance) : 0.0f;
    if (kernel == SplatKernel::kBox) sum += 1.0f;
  }
  return sum;
}

}  // namespace lightwell
