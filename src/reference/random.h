// Random numbers that are a pure function of (seed, pixel, sample, dimension): no state is shared between pixels, so
// the picture does not depend on which thread renders what.
#pragma once

#include <cstdint>

#include <glm/ext/vector_float2.hpp>

namespace lightwell {

// Integer hash with full avalanche (Wellons 2018, "lowbias32").
inline std::uint32_t hash(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

inline std::uint32_t hash_combine(std::uint32_t a, std::uint32_t b) {
  return hash(a ^ (b + 0x9e3779b9u + (a << 6) + (a >> 2)));
}

inline std::uint32_t reverse_bits(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
}

// A random permutation in which every bit is flipped by a hash of the lower bits only (Laine and Karras 2011, Sec. 3.1;
// constants: Vegdahl 2021). On reversed bits that is Owen's nested uniform scrambling.
inline std::uint32_t laine_karras_permutation(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// [0, 1) with 24 bits.
inline float to_unit_interval(std::uint32_t x) {
  return static_cast<float>(x >> 8) * 0x1p-24f;
}

// The numbers of one path: each call returns the next dimension, or pair of dimensions, of a shuffled and scrambled
// Sobol' sequence (Burley 2020, Sec. 5). Over the samples of a pixel every pair is a (0,2)-sequence, hence stratified;
// different pairs, pixels and seeds are independent.
class Sampler {
 public:
  // `sample` counts the paths of the pixel from 0.
  Sampler(std::uint32_t seed, std::uint32_t pixel, std::uint32_t sample)
      : key_(hash_combine(hash(seed), pixel)), sample_(reverse_bits(sample)) {}

  float next_1d() {
    const std::uint32_t key = hash_combine(key_, dimension_++);
    return to_unit_interval(reverse_bits(laine_karras_permutation(shuffled_index(key), hash(key ^ kFirstAxis))));
  }

  glm::vec2 next_2d() {
    const std::uint32_t key = hash_combine(key_, dimension_++);
    const std::uint32_t index = shuffled_index(key);
    // The first Sobol' dimension is the index with its bits reversed, and scrambling works on reversed bits: both
    // reversals cancel.
    const std::uint32_t x = laine_karras_permutation(index, hash(key ^ kFirstAxis));
    const std::uint32_t y =
        laine_karras_permutation(reverse_bits(second_sobol_dimension(index)), hash(key ^ kSecondAxis));
    return {to_unit_interval(reverse_bits(x)), to_unit_interval(reverse_bits(y))};
  }

 private:
  static constexpr std::uint32_t kFirstAxis = 0x68bc21ebu;
  static constexpr std::uint32_t kSecondAxis = 0x02e5be93u;

  // The order in which this pair of dimensions walks through its sequence, so that pairs are not correlated.
  std::uint32_t shuffled_index(std::uint32_t key) const { return reverse_bits(laine_karras_permutation(sample_, key)); }

  // Pascal's matrix modulo 2 times the index (Sobol' 1967), 2^k rows a step.
  static std::uint32_t second_sobol_dimension(std::uint32_t index) {
    std::uint32_t x = reverse_bits(index);
    x ^= (x << 1) & 0xaaaaaaaau;
    x ^= (x << 2) & 0xccccccccu;
    x ^= (x << 4) & 0xf0f0f0f0u;
    x ^= (x << 8) & 0xff00ff00u;
    x ^= (x << 16) & 0xffff0000u;
    return x;
  }

  std::uint32_t key_;
  std::uint32_t sample_;  // bits reversed
  std::uint32_t dimension_ = 0;
};

}  // namespace lightwell
