#include "reference/photon_sources.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/luminance.h"

namespace lightwell {
namespace {

constexpr float kMaxPower = 1e30f;  // of one source, so that sums of sources stay finite
constexpr int kEnvironmentSamples = 1024;

// Uniform over the sphere: z is (Archimedes), and so is the angle about it.
glm::vec3 sample_sphere(glm::vec2 u) {
  const float z = 1.0f - 2.0f * u.x;
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  const float phi = 2.0f * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

// Steradians that a spot's fall-off counts for: the integral of t^2 between its cones is a third of that between them.
float spot_solid_angle(const WorldLight& light) {
  const float range = std::max(0.0f, light.cos_inner - light.cos_outer);
  const float inner = std::max(0.0f, 1.0f - light.cos_outer - range);
  return 2.0f * kPi * (inner + range / 3.0f);
}

// Cosine to the axis with density in proportion to the fall-off: by inversion, in the inner cone or between the cones.
float sample_spot_cosine(const WorldLight& light, float u) {
  const float range = std::max(0.0f, light.cos_inner - light.cos_outer);
  const float inner = std::max(0.0f, 1.0f - light.cos_outer - range);
  const float part = inner / (inner + range / 3.0f);
  if (u < part) return 1.0f - inner * (u / part);
  return light.cos_outer + range * std::cbrt((u - part) / (1.0f - part));
}

glm::vec3 solid_angle_direction(const WorldLight& light, glm::vec2 u) {
  if (light.type == LightType::kPoint) return sample_sphere(u);
  const float cosine = std::clamp(sample_spot_cosine(light, u.x), -1.0f, 1.0f);
  const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
  const float phi = 2.0f * kPi * u.y;
  return make_frame(light.direction) * glm::vec3{sine * std::cos(phi), sine * std::sin(phi), cosine};
}

// Of the three faces of a box that parallel light meets: m^2 across the light.
std::array<float, 3> face_areas(const Bounds& bounds, const glm::vec3& direction) {
  const glm::vec3 size = bounds.maximum - bounds.minimum;
  return {std::abs(direction.x) * size.y * size.z, std::abs(direction.y) * size.z * size.x,
          std::abs(direction.z) * size.x * size.y};
}

float projected_area(const Bounds& bounds, const glm::vec3& direction) {
  const std::array<float, 3> areas = face_areas(bounds, direction);
  return areas[0] + areas[1] + areas[2];
}

struct EnvironmentSample {
  glm::vec3 direction;   // of the light
  glm::vec3 irradiance;  // radiance over density: W/m^2 across the light
};

EnvironmentSample sample_environment(const EnvironmentLight& environment, glm::vec2 u) {
  if (!environment.has_sampling()) {
    const glm::vec3 direction = sample_sphere(u);
    return {-direction, environment.radiance(direction) * (4.0f * kPi)};
  }
  const EnvironmentLight::Sample sample = environment.sample(u);
  return {-sample.direction, sample.density > 0.0f ? environment.radiance(sample) / sample.density : glm::vec3{0.0f}};
}

}  // namespace

Bounds triangle_bounds(const FlatScene& flat) {
  if (flat.triangles.empty()) return {};
  Bounds bounds{flat.corner(0, 0).position, flat.corner(0, 0).position};
  for (std::size_t triangle = 0; triangle < flat.triangles.size(); ++triangle) {
    for (std::size_t i = 0; i < 3; ++i) {
      bounds.minimum = glm::min(bounds.minimum, flat.corner(triangle, i).position);
      bounds.maximum = glm::max(bounds.maximum, flat.corner(triangle, i).position);
    }
  }
  return bounds;
}

PhotonSources::PhotonSources(const TracedWorld& world) : world_(world), bounds_(triangle_bounds(world.flat)) {
  if (world.flat.triangles.empty()) return;
  std::vector<float> powers;
  for (const WorldLight& light : world.lights) powers.push_back(light_power(light));
  powers.push_back(kPi * static_cast<float>(world.emissive_triangles.total_luminance()));
  powers.push_back(environment_power());
  for (float& power : powers) power = power > 0.0f ? std::min(power, kMaxPower) : 0.0f;
  choice_ = DiscreteDistribution(powers);
}

float PhotonSources::light_power(const WorldLight& light) const {
  const float intensity = luminance(light.intensity);
  switch (light.type) {
    case LightType::kPoint:
      return intensity * 4.0f * kPi;
    case LightType::kSpot:
      return intensity * spot_solid_angle(light);
    case LightType::kDirectional:
      return intensity * projected_area(bounds_, light.direction);
  }
  return 0.0f;
}

// How much its share of the photons should be; any guess above 0 is right in the mean.
float PhotonSources::environment_power() const {
  if (world_.environment.is_black()) return 0.0f;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < kEnvironmentSamples; ++i) {
    const EnvironmentSample sample = sample_environment(world_.environment, Sampler(0, 0, i).next_2d());
    sum += double{luminance(sample.irradiance) * projected_area(bounds_, sample.direction)};
  }
  return static_cast<float>(sum / kEnvironmentSamples);
}

PhotonStart PhotonSources::emit(Sampler& sampler) const {
  const DiscreteDistribution::Choice choice = choice_.sample(sampler.next_1d());
  const float u_triangle = sampler.next_1d();
  const glm::vec2 u_position = sampler.next_2d();
  const glm::vec2 u_direction = sampler.next_2d();
  PhotonStart start;
  if (choice.index < world_.lights.size())
    start = from_light(world_.lights[choice.index], u_position, u_direction);
  else if (choice.index == world_.lights.size())
    start = from_triangle(u_triangle, choice.remainder, u_position, u_direction);
  else
    start = from_environment(u_position, u_direction);
  start.flux /= choice.probability;
  return start;
}

PhotonStart PhotonSources::from_light(const WorldLight& light, glm::vec2 u_position, glm::vec2 u_direction) const {
  if (light.type == LightType::kDirectional) return through_box(light.direction, light.intensity, u_position);
  const float solid_angle = light.type == LightType::kPoint ? 4.0f * kPi : spot_solid_angle(light);
  return {{light.position, solid_angle_direction(light, u_direction)}, light.intensity * solid_angle, light.range};
}

// flux = radiance * cosine / (density per m^2 * cosine / pi). A double-sided emitter sends as much to each side.
PhotonStart PhotonSources::from_triangle(float u_choice, float u_side, glm::vec2 u_position,
                                         glm::vec2 u_direction) const {
  const EmissiveTriangles::AreaSample sample = world_.emissive_triangles.sample_area(u_choice, u_position);
  const bool double_sided = world_.flat.material(sample.triangle).double_sided;
  const glm::vec3 normal = double_sided && u_side < 0.5f ? -sample.front : sample.front;
  const glm::vec3 origin = sample.position + clearance_of(world_.flat, sample.triangle) * normal;
  const float sides = double_sided ? 2.0f : 1.0f;
  return {{origin, make_frame(normal) * sample_cosine_hemisphere(u_direction)},
          sample.radiance * (kPi * sides / sample.density)};
}

PhotonStart PhotonSources::from_environment(glm::vec2 u_position, glm::vec2 u_direction) const {
  const EnvironmentSample sample = sample_environment(world_.environment, u_direction);
  return through_box(sample.direction, sample.irradiance, u_position);
}

// A parallel ray through a face of the box that faces the light, from a little before it. `irradiance`:
// W/m^2 across the light.
PhotonStart PhotonSources::through_box(const glm::vec3& direction, const glm::vec3& irradiance, glm::vec2 u) const {
  const std::array<float, 3> areas = face_areas(bounds_, direction);
  const DiscreteDistribution faces(areas);
  if (!(faces.total() > 0.0)) return {};
  const DiscreteDistribution::Choice face = faces.sample(u.x);
  const auto axis = static_cast<glm::length_t>(face.index);
  glm::vec3 part{0.0f};
  part[axis] = direction[axis] > 0.0f ? 0.0f : 1.0f;
  part[(axis + 1) % 3] = face.remainder;
  part[(axis + 2) % 3] = u.y;
  const glm::vec3 size = bounds_.maximum - bounds_.minimum;
  const glm::vec3 largest = glm::max(glm::abs(bounds_.minimum), glm::abs(bounds_.maximum));
  const float before = 0.01f * glm::length(size) + 1e-5f * glm::length(largest);
  return {{bounds_.minimum + part * size - before * direction, direction},
          irradiance * static_cast<float>(faces.total())};
}

}  // namespace lightwell
