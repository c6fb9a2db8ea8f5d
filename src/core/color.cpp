#include "core/color.h"

#include "lightwell/metrics.h"

namespace lightwell {

float srgb_encode(float linear) {
  return static_cast<float>(srgb_from_linear(linear));
}
float srgb_decode(float encoded) {
  return static_cast<float>(linear_from_srgb(encoded));
}

Image tone_map(const Image& radiance, float exposure) {
  Image display(radiance.width, radiance.height, radiance.channels);
  for (std::size_t i = 0; i < radiance.pixels.size(); ++i)
    display.pixels[i] = static_cast<float>(display_value(radiance.pixels[i], exposure));
  return display;
}

}  // namespace lightwell
