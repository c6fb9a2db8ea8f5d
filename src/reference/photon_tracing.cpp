#include "reference/photon_tracing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "reference/lights.h"
#include "reference/parallel.h"
#include "reference/sampling.h"

namespace lightwell {
namespace {

constexpr int kPhotonsABlock = 4096;
constexpr std::uint32_t kPhotonStream = 0x3c6ef372u;  // no random number is one of a camera path's, too

float max_component(const glm::vec3& c) {
  return std::max({c.r, c.g, c.b});
}

// Shading with interpolated normals replaces the cosine of what arrives: seen from the light that is a factor on flux
// (Veach 1997, Sec. 5.3). Where the triangle is flat it is 1.
float shading_factor(const Surface& surface, const glm::vec3& direction) {
  const float geometric = -glm::dot(surface.geometric_normal, direction);
  const float shading = -glm::dot(surface.shading_normal, direction);
  return geometric > 0.0f ? std::max(0.0f, shading) / geometric : 0.0f;
}

void trace_photon(const TracedWorld& world, PhotonStart photon, int max_bounces, float scale, Sampler& sampler,
                  std::vector<Photon>& arrivals) {
  for (int bounce = 0; bounce <= max_bounces; ++bounce) {
    if (!std::isfinite(max_component(photon.flux))) return;
    const std::optional<Surface> surface = world.tracer.closest(photon.ray);
    if (!surface) return;
    photon.flux *= shading_factor(*surface, photon.ray.direction);
    if (bounce == 0) {
      const glm::vec3 way = surface->position - photon.ray.origin;
      photon.flux *= range_falloff(photon.range, glm::dot(way, way));
    }
    if (!(max_component(photon.flux) > 0.0f)) return;
    if (bounce > 0) arrivals.push_back({surface->position, photon.flux * scale, surface->geometric_normal});
    if (bounce == max_bounces) return;

    const glm::vec3 reflected = photon.flux * surface->albedo;
    const float survival = std::min(1.0f, max_component(reflected) / max_component(photon.flux));
    if (!(sampler.next_1d() < survival)) return;
    photon.flux = reflected / survival;
    const glm::vec3 direction = make_frame(surface->geometric_normal) * sample_cosine_hemisphere(sampler.next_2d());
    photon.ray = {surface->start(), direction};
  }
}

}  // namespace

int photon_blocks(int count) {
  return (count + kPhotonsABlock - 1) / kPhotonsABlock;
}

std::vector<Photon> trace_photons(const TracedWorld& world, const PhotonSources& sources, const PhotonTracing& tracing,
                                  const std::function<void()>& on_block) {
  std::vector<std::vector<Photon>> blocks(static_cast<std::size_t>(photon_blocks(tracing.count)));
  const float scale = 1.0f / static_cast<float>(std::max(1, tracing.count));
  run_parallel(tracing.threads, photon_blocks(tracing.count), [&](int block) {
    const int begin = block * kPhotonsABlock;
    const int end = std::min(begin + kPhotonsABlock, tracing.count);
    std::vector<Photon>& arrivals = blocks[static_cast<std::size_t>(block)];
    for (int i = begin; i < end && !sources.empty(); ++i) {
      const std::uint64_t number = tracing.first + static_cast<std::uint64_t>(i);
      Sampler sampler(tracing.seed ^ kPhotonStream, static_cast<std::uint32_t>(number >> 32),
                      static_cast<std::uint32_t>(number));
      trace_photon(world, sources.emit(sampler), tracing.max_bounces, scale, sampler, arrivals);
    }
    if (on_block) on_block();
  });
  std::vector<Photon> photons;
  std::size_t size = 0;
  for (const std::vector<Photon>& block : blocks) size += block.size();
  photons.reserve(size);
  for (std::vector<Photon>& block : blocks) {
    photons.insert(photons.end(), block.begin(), block.end());
    std::vector<Photon>().swap(block);
  }
  return photons;
}

}  // namespace lightwell
