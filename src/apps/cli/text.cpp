#include "apps/cli/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "lightwell/error.h"
#include "lightwell/image.h"

namespace lightwell {

namespace {

template <typename Number>
std::optional<Number> to_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

[[noreturn]] void refuse(std::string_view option, std::string_view text, const std::string& wanted) {
  throw InputError(option, std::string("'").append(text).append("' is not ").append(wanted));
}

}  // namespace

glm::ivec2 parse_size(std::string_view option, std::string_view text) {
  const std::vector<std::string> parts = split(text, 'x');
  glm::ivec2 size(0);
  for (int i = 0; i < 2 && parts.size() == 2; ++i)
    size[i] = to_number<int>(parts[static_cast<std::size_t>(i)]).value_or(0);
  if (std::min(size.x, size.y) < 1 || std::max(size.x, size.y) > kMaxImageSide)
    refuse(option, text, "WIDTHxHEIGHT with 1 to " + std::to_string(kMaxImageSide) + " pixels a side");
  return size;
}

glm::vec3 parse_vector(std::string_view option, std::string_view text) {
  return glm::vec3(parse_position(option, text));
}

glm::dvec3 parse_position(std::string_view option, std::string_view text) {
  const std::vector<std::string> parts = split(text, ',');
  glm::dvec3 position(0.0);
  bool good = parts.size() == 3;
  for (int i = 0; i < 3 && good; ++i) {
    const std::optional<double> value = to_number<double>(parts[static_cast<std::size_t>(i)]);
    good = value && std::abs(*value) <= double{std::numeric_limits<float>::max()};
    position[i] = value.value_or(0.0);
  }
  if (!good) refuse(option, text, "three numbers x,y,z");
  return position;
}

float parse_number(std::string_view option, std::string_view text, float minimum, float maximum) {
  const std::optional<float> value = to_number<float>(text);
  if (value && *value >= minimum && *value <= maximum) return *value;
  char range[64];
  std::snprintf(range, sizeof range, "a number from %g to %g", static_cast<double>(minimum),
                static_cast<double>(maximum));
  refuse(option, text, range);
}

int parse_integer(std::string_view option, std::string_view text, int minimum, int maximum) {
  const std::optional<int> value = to_number<int>(text);
  if (!value || *value < minimum || *value > maximum)
    refuse(option, text, "a whole number from " + std::to_string(minimum) + " to " + std::to_string(maximum));
  return *value;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    parts.emplace_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

}  // namespace lightwell
