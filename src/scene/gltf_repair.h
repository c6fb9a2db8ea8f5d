// Reading numbers of glTF files that only say how something looks or where it is: what is no finite number, or out of
// its range, is mended with a warning, for the rest of the scene can be shown.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf_file.h"

namespace lightwell {

// Empty, with a warning, if it is no string.
std::string read_name(GltfFile& file, const JsonView& json);

// Leaves `out` alone if the value is absent and, with a warning, if it is not exactly that many finite numbers.
void read_numbers(GltfFile& file, const JsonView& json, std::span<float> out);
void read_numbers(GltfFile& file, const JsonView& json, std::span<double> out);
// Of any length; empty if absent or damaged.
std::vector<float> read_number_list(GltfFile& file, const JsonView& json);

// `fallback` if absent or damaged. A number outside of `least` to `most` becomes the nearer of both, with a warning.
float read_number(GltfFile& file, const JsonView& json, float fallback, float least, float most);

// Colours, and what multiplies light: numbers from 0 to `most`.
void read_color(GltfFile& file, const JsonView& json, std::span<float> out, float most);

// Whether all floats of a vector or matrix of floats are finite.
template <typename T>
bool is_finite_value(const T& value) {
  const auto* numbers = reinterpret_cast<const float*>(&value);
  return std::all_of(numbers, numbers + sizeof(T) / sizeof(float), [](float x) { return std::isfinite(x); });
}

// Puts `replacement` in place of every element with a number that is not finite; `what` says so in the warning, `json`
// is where they come from.
template <typename T>
void replace_not_finite(GltfFile& file, const JsonView& json, std::vector<T>& values, const T& replacement,
                        std::string_view what) {
  std::size_t count = 0;
  for (T& value : values) {
    if (is_finite_value(value)) continue;
    value = replacement;
    ++count;
  }
  if (count > 0) file.note(json, what, count);
}

}  // namespace lightwell
