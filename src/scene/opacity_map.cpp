#include "scene/opacity_map.h"

#include <algorithm>
#include <cstdint>

namespace lightwell {

namespace {

std::uint8_t mask_value(const std::uint8_t* rgba, char channel, bool has_alpha) {
  switch (channel) {
    case 'r':
      return rgba[0];
    case 'g':
      return rgba[1];
    case 'b':
      return rgba[2];
    case 'm':
      return rgba[3];
    default:
      if (has_alpha && channel != 'l') return rgba[3];
      return static_cast<std::uint8_t>((rgba[0] + rgba[1] + rgba[2]) / 3);
  }
}

// The texel of a texture that lies at pixel (x, y) of an image of that size.
const std::uint8_t* texel_at(const Texture& texture, int x, int y, const ImageSize& size) {
  const auto column = static_cast<std::size_t>(std::int64_t{x} * texture.width / size.width);
  const auto row = static_cast<std::size_t>(std::int64_t{y} * texture.height / size.height);
  return texture.rgba.data() + 4 * (row * static_cast<std::size_t>(texture.width) + column);
}

}  // namespace

bool has_alpha_below(const Texture& texture, int below) {
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4)
    if (texture.rgba[i] < below) return true;
  return false;
}

ImageSize masked_size(const Texture* color, const Texture& mask) {
  return {std::max(mask.width, color ? color->width : 0), std::max(mask.height, color ? color->height : 0)};
}

Texture with_mask(const Texture* color, const Texture& mask, char channel) {
  const ImageSize size = masked_size(color, mask);
  Texture made;
  made.name = mask.name;
  made.width = size.width;
  made.height = size.height;
  made.rgba.assign(std::size_t{4} * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height), 255);
  const bool has_alpha = has_alpha_below(mask, 255);
  std::uint8_t* texel = made.rgba.data();
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x, texel += 4) {
      if (color) std::copy_n(texel_at(*color, x, y, size), 3, texel);
      texel[3] = mask_value(texel_at(mask, x, y, size), channel, has_alpha);
    }
  return made;
}

}  // namespace lightwell
