#include "passes/light_paths/path_sequence.h"

#include <array>
#include <cstddef>

#include "passes/light_paths/light_path_dimensions.h"

namespace lightwell {
namespace {

// A primitive polynomial over GF(2), x^degree + ... + 1, and the first `degree` direction numbers.
struct Generator {
  std::uint32_t degree;
  std::uint32_t inner;  // the polynomial's coefficients between its first and its last, highest first
  std::array<std::uint32_t, 5> first;
};

constexpr std::array<Generator, glsl::kJointDimensions - 1> kGenerators{{{1, 0, {1}},
                                                                         {2, 1, {1, 3}},
                                                                         {3, 1, {1, 3, 1}},
                                                                         {3, 2, {1, 1, 1}},
                                                                         {4, 1, {1, 1, 3, 3}},
                                                                         {4, 4, {1, 3, 5, 13}},
                                                                         {5, 2, {1, 1, 5, 5, 17}},
                                                                         {5, 4, {1, 1, 5, 5, 5}},
                                                                         {5, 7, {1, 1, 7, 11, 19}}}};

std::uint32_t reverse_bits(std::uint32_t word) {
  std::uint32_t reversed = 0;
  for (int bit = 0; bit < 32; ++bit) reversed |= ((word >> bit) & 1u) << (31 - bit);
  return reversed;
}

}  // namespace

std::vector<std::uint32_t> make_sobol_matrices() {
  std::vector<std::uint32_t> matrices;
  for (std::uint32_t i = 0; i < 32; ++i) matrices.push_back(1u << i);
  for (const Generator& generator : kGenerators) {
    std::array<std::uint32_t, 32> v;  // digits from the highest bit on
    for (std::uint32_t i = 0; i < 32; ++i) {
      if (i < generator.degree) {
        v[i] = generator.first[i] << (31 - i);
        continue;
      }
      v[i] = v[i - generator.degree] ^ (v[i - generator.degree] >> generator.degree);
      for (std::uint32_t k = 1; k < generator.degree; ++k)
        if ((generator.inner >> (generator.degree - 1 - k) & 1u) != 0) v[i] ^= v[i - k];
    }
    for (const std::uint32_t word : v) matrices.push_back(reverse_bits(word));
  }
  return matrices;
}

}  // namespace lightwell
