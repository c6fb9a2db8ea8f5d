#include "reference/environment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/luminance.h"

namespace lightwell {
namespace {

glm::vec3 direction_of(glm::vec2 uv) {
  const float phi = 2.0f * kPi * (uv.x - 0.5f);
  const float theta = kPi * uv.y;
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

// The sine of the polar angle; sqrt(1 - y^2) would lose all its digits near the poles.
float sin_polar_angle(const glm::vec3& d) {
  return std::sqrt(d.x * d.x + d.z * d.z);
}

glm::vec2 map_position(const glm::vec3& d) {
  return {std::atan2(d.x, -d.z) / (2.0f * kPi) + 0.5f, std::atan2(sin_polar_angle(d), d.y) / kPi};
}

int texel_index(float coordinate, int size) {
  return std::clamp(static_cast<int>(coordinate * static_cast<float>(size)), 0, size - 1);
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment) : environment_(environment) {
  black_ = environment.radiance == glm::vec3{0.0f};
  const Image& map = environment.map;
  if (black_ || map.width <= 0 || map.height <= 0) return;
  std::vector<float> row_weights;
  std::vector<float> weights(static_cast<std::size_t>(map.width));
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) weights[static_cast<std::size_t>(x)] = mean_luminance(x, y);
    columns_.emplace_back(weights);
    // A row's solid angle is in proportion to the sine of its polar angle.
    const float sin_theta = std::sin(kPi * (static_cast<float>(y) + 0.5f) / static_cast<float>(map.height));
    row_weights.push_back(static_cast<float>(columns_.back().total()) * sin_theta);
  }
  rows_ = DiscreteDistribution(row_weights);
}

glm::vec3 EnvironmentLight::texel(int x, int y) const {
  const Image& map = environment_.map;
  const float* rgb = map.at((x + map.width) % map.width, std::clamp(y, 0, map.height - 1));
  return {rgb[0], rgb[1], rgb[2]};
}

// The mean over a texel's square of the bilinear interpolation, which reaches into the neighbours: weights 1, 6, 1.
float EnvironmentLight::mean_luminance(int x, int y) const {
  constexpr float kWeights[3] = {0.125f, 0.75f, 0.125f};
  glm::vec3 mean{0.0f};
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) mean += kWeights[i + 1] * kWeights[j + 1] * texel(x + i, y + j);
  }
  return std::max(0.0f, luminance(environment_.radiance * mean));
}

glm::vec3 EnvironmentLight::radiance_at(glm::vec2 uv) const {
  const float x = uv.x * static_cast<float>(environment_.map.width) - 0.5f;
  const float y = uv.y * static_cast<float>(environment_.map.height) - 0.5f;
  const float left = std::floor(x);
  const float top = std::floor(y);
  const float fx = x - left;
  const float fy = y - top;
  const int x0 = static_cast<int>(left);
  const int y0 = static_cast<int>(top);
  const glm::vec3 upper = (1.0f - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0);
  const glm::vec3 lower = (1.0f - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1);
  return environment_.radiance * ((1.0f - fy) * upper + fy * lower);
}

glm::vec3 EnvironmentLight::radiance(const glm::vec3& direction) const {
  if (black_ || environment_.map.width <= 0) return environment_.radiance;
  return radiance_at(map_position(direction));
}

// p(direction) = p(u, v) / (2 pi^2 sin(theta)), the Jacobian of the map; p(u, v) is constant in a texel.
float EnvironmentLight::density_at(int x, int y, float sin_theta) const {
  if (sin_theta <= 0.0f) return 0.0f;
  const auto row = static_cast<std::size_t>(y);
  const float probability = rows_.probability(row) * columns_[row].probability(static_cast<std::size_t>(x));
  const float texels = static_cast<float>(environment_.map.width) * static_cast<float>(environment_.map.height);
  return probability * texels / (2.0f * kPi * kPi * sin_theta);
}

EnvironmentLight::Sample EnvironmentLight::sample(glm::vec2 u) const {
  const DiscreteDistribution::Choice row = rows_.sample(u.y);
  const DiscreteDistribution::Choice column = columns_[row.index].sample(u.x);
  const glm::vec2 uv{(static_cast<float>(column.index) + column.remainder) / static_cast<float>(environment_.map.width),
                     (static_cast<float>(row.index) + row.remainder) / static_cast<float>(environment_.map.height)};
  const float density = density_at(static_cast<int>(column.index), static_cast<int>(row.index), std::sin(kPi * uv.y));
  return {direction_of(uv), density, uv};
}

float EnvironmentLight::density(const glm::vec3& direction) const {
  if (!has_sampling()) return 0.0f;
  const glm::vec2 uv = map_position(direction);
  return density_at(texel_index(uv.x, environment_.map.width), texel_index(uv.y, environment_.map.height),
                    sin_polar_angle(direction));
}

}  // namespace lightwell
