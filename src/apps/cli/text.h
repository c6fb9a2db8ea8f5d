// Values of command-line options. All throw InputError naming the option, the bad text and what was wanted.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_int2.hpp>

#include "core/join.h"

namespace lightwell {

// "WIDTHxHEIGHT", 1 to kMaxImageSide each.
glm::ivec2 parse_size(std::string_view option, std::string_view text);

// "x,y,z", finite.
glm::vec3 parse_vector(std::string_view option, std::string_view text);
// The same for a place, which may be far from 0.
glm::dvec3 parse_position(std::string_view option, std::string_view text);

// Finite and in [minimum, maximum].
float parse_number(std::string_view option, std::string_view text, float minimum, float maximum);

int parse_integer(std::string_view option, std::string_view text, int minimum, int maximum);

std::vector<std::string> split(std::string_view text, char separator);

}  // namespace lightwell
