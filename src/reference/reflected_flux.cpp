#include "reference/reflected_flux.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "reference/path_integrator.h"
#include "reference/random.h"
#include "reference/sampling.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSamplesAChunk = 1024;

// Seen along the normal from 64 times the room that rounding needs.
constexpr float kClearances = 64.0f;

ReflectedFlux sample_point(const TracedWorld& world, const DiscreteDistribution& areas, int surfaces,
                           Sampler& sampler) {
  const DiscreteDistribution::Choice choice = areas.sample(sampler.next_1d());
  const std::size_t triangle = choice.index;
  const glm::vec2 weights = sample_triangle(sampler.next_2d());
  const glm::vec3 side = glm::normalize(world.flat.area_normal(triangle)) * (sampler.next_1d() < 0.5f ? -1.0f : 1.0f);
  const glm::vec3 position = world.flat.position(triangle, weights.x, weights.y);
  const float distance = kClearances * clearance_of(world.flat, triangle);
  const PathSample sample = sample_path(world, {position + distance * side, -side}, surfaces - 1, sampler);
  // Where an alpha mask cuts the triangle out, the ray goes on.
  if (!sample.hit || glm::distance(sample.position, position) > distance) return {};
  return {glm::dvec3(sample.direct), glm::dvec3(sample.indirect)};
}

}  // namespace

ReflectedFlux integrate_reflected_flux(const Scene& scene, const SceneSnapshot& snapshot, int surfaces,
                                       std::uint32_t samples, std::uint32_t seed) {
  const TracedWorld world(scene, snapshot);
  std::vector<float> areas;
  double area = 0.0;
  for (std::size_t i = 0; i < world.flat.triangles.size(); ++i) {
    areas.push_back(0.5f * glm::length(world.flat.area_normal(i)));
    area += double{areas.back()};
  }
  if (area <= 0.0) return {};
  const DiscreteDistribution distribution(areas);
  std::vector<ReflectedFlux> chunks((samples + kSamplesAChunk - 1) / kSamplesAChunk);
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t chunk) {
    const auto first = static_cast<std::uint32_t>(chunk) * kSamplesAChunk;
    for (std::uint32_t i = first; i < std::min(first + kSamplesAChunk, samples); ++i) {
      Sampler sampler(seed, 0, i);
      const ReflectedFlux sample = sample_point(world, distribution, surfaces, sampler);
      chunks[chunk].first += sample.first;
      chunks[chunk].further += sample.further;
    }
  });
  ReflectedFlux sum;
  for (const ReflectedFlux& chunk : chunks) {
    sum.first += chunk.first;
    sum.further += chunk.further;
  }
  const double scale = 2.0 * area * double{kPi} / samples;
  return {scale * sum.first, scale * sum.further};
}

}  // namespace lightwell
