#include "reference/path_integrator.h"

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>

#include "core/luminance.h"
#include "reference/sampling.h"

namespace lightwell {
namespace {

constexpr int kBouncesBeforeRoulette = 4;
constexpr float kMostSurvival = 0.98f;  // so that paths end even where nothing is absorbed

float max_component(const glm::vec3& c) {
  return std::max({c.r, c.g, c.b});
}

// Cosine to the shading normal; 0 for directions below the triangle itself, so that interpolated normals do not let
// light through. On flat surfaces both normals are the same and nothing is lost.
float cosine_above(const Surface& surface, const glm::vec3& direction) {
  if (glm::dot(surface.geometric_normal, direction) <= 0.0f) return 0.0f;
  return std::max(0.0f, glm::dot(surface.shading_normal, direction));
}

// The functions below estimate irradiance (W/m^2) on a surface from one kind of light each.

// One punctual light, chosen in proportion to what it would give unblocked, found in one pass over all of them
// (weighted reservoir sampling, Chao 1982); u is rescaled after each decision and stays uniform.
glm::vec3 irradiance_from_punctual_lights(const TracedWorld& world, const Surface& surface, float u) {
  const glm::vec3 start = surface.start();
  float weight_sum = 0.0f;
  float chosen_weight = 0.0f;
  glm::vec3 chosen_irradiance{0.0f};
  Illumination chosen{};
  for (const WorldLight& light : world.lights) {
    const Illumination illumination = illuminate(light, start);
    const glm::vec3 irradiance = illumination.irradiance * cosine_above(surface, illumination.direction);
    const float weight = luminance(irradiance);
    if (!(weight > 0.0f)) continue;
    weight_sum += weight;
    const float accept = weight / weight_sum;
    if (u < accept) {
      u /= accept;
      chosen_weight = weight;
      chosen_irradiance = irradiance;
      chosen = illumination;
    } else {
      u = (u - accept) / (1.0f - accept);
    }
  }
  if (chosen_weight == 0.0f || world.tracer.is_blocked(start, chosen.to_light, chosen.t_max)) return glm::vec3{0.0f};
  return chosen_irradiance * (weight_sum / chosen_weight);
}

glm::vec3 irradiance_from_emissive_triangles(const TracedWorld& world, const Surface& surface, float u_choice,
                                             glm::vec2 u_area) {
  const EmissiveTriangles::Sample sample = world.emissive_triangles.sample(u_choice, u_area, surface.position);
  if (sample.density <= 0.0f) return glm::vec3{0.0f};
  const glm::vec3 start = surface.start();
  const glm::vec3 to_light = sample.position - start;
  const float cosine = cosine_above(surface, glm::normalize(to_light));
  if (cosine <= 0.0f || world.tracer.is_blocked(start, to_light, 1.0f)) return glm::vec3{0.0f};
  return sample.radiance * (cosine * power_heuristic(sample.density, cosine / kPi) / sample.density);
}

glm::vec3 irradiance_from_environment(const TracedWorld& world, const Surface& surface, glm::vec2 u) {
  const EnvironmentLight::Sample sample = world.environment.sample(u);
  const float cosine = cosine_above(surface, sample.direction);
  if (sample.density <= 0.0f || cosine <= 0.0f) return glm::vec3{0.0f};
  if (world.tracer.is_blocked(surface.start(), sample.direction, std::numeric_limits<float>::infinity()))
    return glm::vec3{0.0f};
  return world.environment.radiance(sample) * (cosine * power_heuristic(sample.density, cosine / kPi) / sample.density);
}

// Next-event estimation: one sample of every kind of light there is.
glm::vec3 irradiance_from_lights(const TracedWorld& world, const Surface& surface, Sampler& sampler) {
  glm::vec3 irradiance{0.0f};
  if (!world.lights.empty()) irradiance += irradiance_from_punctual_lights(world, surface, sampler.next_1d());
  if (!world.emissive_triangles.empty()) {
    const float u_choice = sampler.next_1d();
    irradiance += irradiance_from_emissive_triangles(world, surface, u_choice, sampler.next_2d());
  }
  if (world.environment.has_sampling()) irradiance += irradiance_from_environment(world, surface, sampler.next_2d());
  return irradiance;
}

// Radiance that a cosine-sampled ray found, weighted against next-event estimation's chance to find the same.
glm::vec3 weighted_emission(const TracedWorld& world, const Surface& from, const glm::vec3& direction,
                            const std::optional<Surface>& to) {
  const float density = cosine_above(from, direction) / kPi;
  if (!to) {
    return world.environment.radiance(direction) * power_heuristic(density, world.environment.density(direction));
  }
  if (to->emission == glm::vec3{0.0f}) return glm::vec3{0.0f};
  const float light_density =
      world.emissive_triangles.density(to->triangle, to->position, to->geometric_normal, from.position);
  return to->emission * power_heuristic(density, light_density);
}

// Adds the light that reaches the camera by way of `surface`, the visible one: throughput is what the path lets
// through of the radiance that leaves its present end.
void add_reflected_light(const TracedWorld& world, Surface surface, int max_bounces, Sampler& sampler,
                         BounceEnergy* energy, PathSample& result) {
  const bool rays_find_light = !world.emissive_triangles.empty() || !world.environment.is_black();
  glm::vec3 throughput{1.0f};
  for (int bounce = 0; bounce <= max_bounces; ++bounce) {
    const auto add = [&](const glm::vec3& light) {
      (bounce == 0 ? result.direct : result.indirect) += light;
      if (energy) energy->add(bounce, double{luminance(light)});
    };
    throughput *= surface.albedo;
    if (max_component(throughput) <= 0.0f) return;
    if (energy) energy->arrive(bounce, double{luminance(throughput)});
    // Lambert: radiance = albedo / pi * irradiance.
    add(throughput / kPi * irradiance_from_lights(world, surface, sampler));

    if (bounce == max_bounces && !rays_find_light) return;
    if (bounce >= kBouncesBeforeRoulette) {
      const float survival = std::min(kMostSurvival, max_component(throughput));
      if (sampler.next_1d() >= survival) return;
      throughput /= survival;
    }
    // Cosine sampling: brdf * cos / density = albedo, which the next turn or the lines above multiply in.
    const glm::vec3 direction = make_frame(surface.shading_normal) * sample_cosine_hemisphere(sampler.next_2d());
    if (cosine_above(surface, direction) <= 0.0f) return;
    const std::optional<Surface> next = world.tracer.closest({surface.start(), direction});
    add(throughput * weighted_emission(world, surface, direction, next));
    if (!next) return;
    surface = *next;
  }
}

}  // namespace

TracedWorld::TracedWorld(const Scene& scene, const SceneSnapshot& snapshot)
    : flat(flatten(scene, snapshot)),
      tracer(flat),
      emissive_triangles(flat),
      environment(scene.environment),
      lights(snapshot.lights) {}

PathSample sample_path(const TracedWorld& world, const Ray& camera_ray, int max_bounces, Sampler& sampler,
                       BounceEnergy* energy) {
  PathSample result;
  const std::optional<Surface> visible = world.tracer.closest(camera_ray);
  if (!visible) {
    result.emission = world.environment.radiance(glm::normalize(camera_ray.direction));
    return result;
  }
  result.hit = true;
  result.position = visible->position;
  result.normal = visible->shading_normal;
  result.geometric_normal = visible->geometric_normal;
  result.albedo = visible->albedo;
  result.emission = visible->emission;
  add_reflected_light(world, *visible, max_bounces, sampler, energy, result);
  return result;
}

}  // namespace lightwell
