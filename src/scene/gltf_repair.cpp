#include "scene/gltf_repair.h"

namespace lightwell {

namespace {

template <typename T>
void read_numbers_of(GltfFile& file, const JsonView& json, std::span<T> out) {
  if (json.present() && !json.read_if_finite(out))
    file.note(json, "is not " + std::to_string(out.size()) + " finite numbers: taken as not there");
}

}  // namespace

std::string read_name(GltfFile& file, const JsonView& json) {
  if (json.is_string()) return json.string("");
  if (json.present()) file.note(json, "is no string: taken as no name");
  return "";
}

void read_numbers(GltfFile& file, const JsonView& json, std::span<float> out) {
  read_numbers_of(file, json, out);
}

void read_numbers(GltfFile& file, const JsonView& json, std::span<double> out) {
  read_numbers_of(file, json, out);
}

std::vector<float> read_number_list(GltfFile& file, const JsonView& json) {
  std::vector<float> values(json.size());
  if (json.read_if_finite(values)) return values;
  if (json.present()) file.note(json, "holds what is no finite number: taken as not there");
  return {};
}

float read_number(GltfFile& file, const JsonView& json, float fallback, float least, float most) {
  if (!json.present()) return fallback;
  if (!json.is_finite_number()) {
    file.note(json, "is no finite number: taken as not there");
    return fallback;
  }
  const float number = json.number(fallback);
  if (number >= least && number <= most) return number;
  file.note(json, "is out of its range: brought to its end");
  return std::clamp(number, least, most);
}

void read_color(GltfFile& file, const JsonView& json, std::span<float> out, float most) {
  read_numbers(file, json, out);
  bool limited = false;
  for (float& number : out) {
    const float possible = std::clamp(number, 0.0f, most);
    limited = limited || possible != number;
    number = possible;
  }
  if (limited) file.note(json, "is negative or too large: brought into its range");
}

}  // namespace lightwell
