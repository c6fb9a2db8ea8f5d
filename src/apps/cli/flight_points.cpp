#include "apps/cli/flight_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "lightwell/error.h"
#include "reference/parallel.h"
#include "reference/path_integrator.h"
#include "reference/random.h"
#include "reference/sampling.h"

namespace lightwell {

namespace {

constexpr int kRaysPerPlace = 100;  // that are tried at most

std::vector<Surface> random_places(const TracedWorld& world, const std::vector<glm::vec3>& eyes, int count,
                                   std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<float> normal;
  std::uniform_int_distribution<std::size_t> choose(0, eyes.size() - 1);
  std::vector<Surface> places;
  for (int i = 0; i < kRaysPerPlace * count && static_cast<int>(places.size()) < count; ++i) {
    const glm::vec3& eye = eyes[choose(engine)];
    const float x = normal(engine), y = normal(engine), z = normal(engine);
    const std::optional<Surface> surface = world.tracer.closest({eye, glm::normalize(glm::vec3(x, y, z)), 0.0f});
    if (surface && surface->emission == glm::vec3(0.0f)) places.push_back(*surface);
  }
  if (static_cast<int>(places.size()) < count)
    throw InputError("--points", "the camera's path sees no more than " + std::to_string(places.size()));
  return places;
}

// E = pi times the mean radiance of cosine-distributed directions; what comes straight from lights and the environment
// is left out.
// Returns it and its standard error.
std::pair<double, double> bounced_irradiance(const TracedWorld& world, const Surface& place, int rays, int bounces,
                                             std::uint32_t seed, std::uint32_t number) {
  const glm::mat3 frame = make_frame(place.geometric_normal);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < rays; ++i) {
    Sampler sampler(seed, number, static_cast<std::uint32_t>(i));
    const glm::vec3 direction = frame * sample_cosine_hemisphere(sampler.next_2d());
    const PathSample seen = sample_path(world, {place.start(), direction, 0.0f}, bounces, sampler);
    const glm::dvec3 radiance = seen.direct + seen.indirect;
    const double irradiance = std::numbers::pi * (radiance.x + radiance.y + radiance.z) / 3.0;
    sum += irradiance;
    squares += irradiance * irradiance;
  }
  const double mean = sum / rays;
  return {mean, std::sqrt(std::max(squares / rays - mean * mean, 0.0) / rays)};
}

}  // namespace

FlightPlaces find_flight_places(const Scene& scene, const std::function<Moment(int)>& moment_at, int frames, int count,
                                int rays, int bounces, std::uint32_t seed) {
  const TracedWorld world(scene, moment_at(0).world);
  std::vector<glm::vec3> eyes;
  for (int frame = 0; frame < frames; ++frame) eyes.push_back(moment_at(frame).camera.position);
  const std::vector<Surface> places = random_places(world, eyes, count, seed);
  FlightPlaces found;
  for (const Surface& place : places)
    found.points.push_back({glm::vec4(place.position, 1.0f), glm::vec4(place.geometric_normal, 0.0f)});
  found.irradiance.resize(places.size());
  found.noise.resize(places.size());
  run_parallel(0, count, [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    std::tie(found.irradiance[index], found.noise[index]) =
        bounced_irradiance(world, places[index], rays, bounces, seed, static_cast<std::uint32_t>(i));
  });
  return found;
}

}  // namespace lightwell
