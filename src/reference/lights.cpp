#include "reference/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "core/luminance.h"
#include "reference/ray_tracer.h"

namespace lightwell {
namespace {

// t^2 with t rising from 0 at the outer to 1 at the inner cone (KHR_lights_punctual).
float spot_falloff(const WorldLight& light, float cos_angle) {
  const float range = light.cos_inner - light.cos_outer;
  if (range <= 0.0f) return cos_angle >= light.cos_outer ? 1.0f : 0.0f;
  const float t = std::clamp((cos_angle - light.cos_outer) / range, 0.0f, 1.0f);
  return t * t;
}

// Mean emission over a triangle; with a texture, over the centres of 64 equal parts.
float mean_luminance(const FlatScene& flat, std::size_t triangle) {
  constexpr int kSide = 8;
  const Material& material = flat.material(triangle);
  if (material.emission_texture.texture < 0) return luminance(material.emission);
  float sum = 0.0f;
  for (int i = 0; i < kSide * kSide; ++i) {
    const glm::vec2 u{(static_cast<float>(i % kSide) + 0.5f) / kSide, (static_cast<float>(i / kSide) + 0.5f) / kSide};
    const glm::vec2 weights = sample_triangle(u);
    sum += luminance(emitted_radiance(*flat.scene, material, flat.texcoords(triangle, weights.x, weights.y)));
  }
  return sum / (kSide * kSide);
}

}  // namespace

float range_falloff(float range, float distance_squared) {
  const float square = distance_squared / range / range;
  return std::max(1.0f - square * square, 0.0f);
}

Illumination illuminate(const WorldLight& light, const glm::vec3& point) {
  if (light.type == LightType::kDirectional) {
    return {-light.direction, std::numeric_limits<float>::infinity(), -light.direction, light.intensity};
  }
  const glm::vec3 to_light = light.position - point;
  const float distance_squared = glm::dot(to_light, to_light);
  if (!(distance_squared > 0.0f)) return {to_light, 1.0f, glm::vec3{0.0f}, glm::vec3{0.0f}};
  const glm::vec3 direction = to_light / std::sqrt(distance_squared);
  const float falloff =
      light.type == LightType::kSpot ? spot_falloff(light, glm::dot(light.direction, -direction)) : 1.0f;
  const float in_range = range_falloff(light.range, distance_squared);
  return {to_light, 1.0f, direction, light.intensity * (in_range * falloff / distance_squared)};
}

EmissiveTriangles::EmissiveTriangles(const FlatScene& flat) : flat_(flat) {
  std::vector<float> luminances;
  std::vector<float> powers;
  for (std::size_t triangle = 0; triangle < flat.triangles.size(); ++triangle) {
    if (flat.material(triangle).emission == glm::vec3{0.0f}) continue;
    const float mean = mean_luminance(flat, triangle);
    if (!(mean > 0.0f)) continue;
    emitters_.push_back(triangle);
    luminances.push_back(mean);
    powers.push_back(mean * 0.5f * glm::length(flat.area_normal(triangle)));
  }
  if (emitters_.empty()) return;
  choice_ = DiscreteDistribution(powers);
  area_density_.resize(flat.triangles.size());
  // probability / area = (luminance * area / total) / area
  for (std::size_t i = 0; i < emitters_.size(); ++i) {
    area_density_[emitters_[i]] = static_cast<float>(static_cast<double>(luminances[i]) / choice_.total());
  }
}

// Area to solid angle: d omega = cos / d^2 dA (Veach 1997, Eq. 8.2).
float EmissiveTriangles::density(std::size_t triangle, const glm::vec3& position, const glm::vec3& normal,
                                 const glm::vec3& point) const {
  if (empty()) return 0.0f;
  const glm::vec3 offset = position - point;
  const float distance_squared = glm::dot(offset, offset);
  const float cosine = std::abs(glm::dot(normal, offset)) / std::sqrt(distance_squared);
  return cosine > 0.0f ? area_density_[triangle] * distance_squared / cosine : 0.0f;
}

EmissiveTriangles::AreaSample EmissiveTriangles::sample_area(float u_choice, glm::vec2 u_area) const {
  const std::size_t triangle = emitters_[choice_.sample(u_choice).index];
  const glm::vec2 weights = sample_triangle(u_area);
  const Material& material = flat_.material(triangle);
  const TexcoordSets texcoords = flat_.texcoords(triangle, weights.x, weights.y);
  const float alpha = flat_.color(triangle, weights.x, weights.y).a;
  const bool cut_out = is_cut_out(*flat_.scene, material, texcoords, alpha);
  return {triangle, flat_.position(triangle, weights.x, weights.y), glm::normalize(flat_.area_normal(triangle)),
          cut_out ? glm::vec3{0.0f} : emitted_radiance(*flat_.scene, material, texcoords), area_density_[triangle]};
}

EmissiveTriangles::Sample EmissiveTriangles::sample(float u_choice, glm::vec2 u_area, const glm::vec3& point) const {
  const AreaSample sample = sample_area(u_choice, u_area);
  const bool lit_from_front = glm::dot(sample.front, point - sample.position) > 0.0f;
  const bool shines = lit_from_front || flat_.material(sample.triangle).double_sided;
  if (!shines || sample.radiance == glm::vec3{0.0f}) return {sample.position, glm::vec3{0.0f}, 0.0f};
  const glm::vec3 normal = lit_from_front ? sample.front : -sample.front;
  return {sample.position + clearance_of(flat_, sample.triangle) * normal, sample.radiance,
          density(sample.triangle, sample.position, normal, point)};
}

}  // namespace lightwell
