#include "scene/environment_map.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "core/files.h"
#include "core/image_formats.h"
#include "core/log.h"
#include "core/shrink.h"
#include "lightwell/scene.h"

namespace lightwell {

namespace {

// What is no light becomes some: infinities the largest number of the map, or where halves end if that is more; what is
// no number, black. Filters leave negative light beside bright spots, of which nobody need be told.
void limit_radiance(const std::string& subject, Image& map) {
  constexpr float kLargestHalf = 65504.0f;
  float largest = kLargestHalf;
  for (const float value : map.pixels)
    if (value <= kMaxLight) largest = std::max(largest, value);
  std::size_t changed = 0;
  std::string place;
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    float& value = map.pixels[i];
    const bool is_light = value <= kMaxLight && value >= -kMaxLight;
    if (!is_light && changed++ == 0) {
      const std::size_t pixel = i / 3;
      const auto width = static_cast<std::size_t>(map.width);
      place = "x " + std::to_string(pixel % width) + ", y " + std::to_string(pixel / width);
    }
    value = is_light || value > 0.0f ? std::clamp(value, 0.0f, largest) : 0.0f;
  }
  if (changed == 0) return;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", static_cast<double>(largest));
  log_warning(subject + ": " + std::to_string(changed) +
              " values are infinite, no numbers or more than 1e18, the first at " + place + "; infinities become " +
              text.data() + ", what is no number 0");
}

// A sphere of more pixels shows no more in a picture, and costs gigabytes.
void limit_size(const std::string& subject, Image& map) {
  constexpr int kLargestWidth = 8192;
  if (map.width <= kLargestWidth) return;
  const int height = std::max(1, static_cast<int>(std::int64_t{map.height} * kLargestWidth / map.width));
  log_warning(subject + ": map of " + std::to_string(map.width) + "x" + std::to_string(map.height) + " brought to " +
              std::to_string(kLargestWidth) + "x" + std::to_string(height));
  map = shrink(map, kLargestWidth, height);
}

}  // namespace

Image load_environment_map(const std::string& path) {
  Image map;
  {
    const std::vector<std::uint8_t> bytes = read_file(path);
    if (!has_high_range(bytes)) {
      const ImageSize size = image8_size(path, bytes.data(), bytes.size());
      check_image_size(path, size.width, size.height, bytes.size(), kFloatPixelsPerByte);
      log_warning(path + ": no format for light: nothing in it is brighter than white, a sun is far too dim");
    }
    map = decode_image(path, bytes);
  }
  limit_radiance(path, map);
  limit_size(path, map);
  return map;
}

}  // namespace lightwell
