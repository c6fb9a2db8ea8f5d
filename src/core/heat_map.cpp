#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/ext/vector_double3.hpp>

#include "core/color.h"
#include "core/color_space.h"
#include "lightwell/error.h"
#include "lightwell/metrics.h"

namespace lightwell {

namespace {

// A path through L*a*b*: lightness rises evenly from black to near white while the hue turns from violet over red to
// yellow; chroma is small at the ends, where sRGB has little of it. Equal steps of x look equally far apart.
glm::dvec3 heat_color(double x) {
  const double lightness = 97 * x;
  const double chroma = 68 * std::sin(std::numbers::pi * x);
  const double hue = (-55 + 155 * x) * std::numbers::pi / 180;
  const glm::dvec3 rgb = rgb_from_lab({lightness, chroma * std::cos(hue), chroma * std::sin(hue)});
  const glm::dvec3 inside = glm::clamp(rgb, 0.0, 1.0);
  return {srgb_from_linear(inside.x), srgb_from_linear(inside.y), srgb_from_linear(inside.z)};
}

}  // namespace

Image difference_heat_map(const Image& test, const Image& reference, float exposure) {
  if (test.width != reference.width || test.height != reference.height)
    throw InputError("difference", "images differ in size");
  std::array<glm::dvec3, 256> colors;
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = heat_color(static_cast<double>(i) / 255);

  Image map(test.width, test.height, 3);
  for (std::size_t i = 0; i < map.pixels.size(); i += 3) {
    double difference = 0;
    for (std::size_t c = 0; c < 3; ++c)
      difference +=
          std::abs(display_value(test.pixels[i + c], exposure) - display_value(reference.pixels[i + c], exposure));
    // A pixel that is not a number is shown as the largest difference.
    const double scaled = std::isnan(difference) ? 1.0 : std::min(4 * difference, 1.0);
    const glm::dvec3& color = colors[static_cast<std::size_t>(std::lround(scaled * 255))];
    for (std::size_t c = 0; c < 3; ++c) map.pixels[i + c] = static_cast<float>(color[static_cast<int>(c)]);
  }
  return map;
}

}  // namespace lightwell
