// The Sobol sequence that light paths take their numbers from.
#pragma once

#include <cstdint>
#include <vector>

namespace lightwell {

// Generating matrices of dimensions 0 to glsl::kJointDimensions - 1 (Sobol 1967; initial numbers: Joe and Kuo 2008): 32
// words a dimension; point i's digits are the xor of the words of i's bits, bit 0 the first binary digit.
std::vector<std::uint32_t> make_sobol_matrices();

}  // namespace lightwell
