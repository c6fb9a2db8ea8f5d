#include "reference/photon_disc.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "reference/photon_map.h"
#include "reference/sampling.h"

namespace lightwell {
namespace {

// A Fibonacci lattice of 13 points.
constexpr int kRays = 13;
constexpr float kSecondStep = 8.0f;

}  // namespace

float part_on_surface(const TracedWorld& world, const glm::vec3& point, const glm::vec3& normal, float radius,
                      Sampler& sampler) {
  if (!(radius > 0.0f)) return 1.0f;
  const glm::mat3 frame = make_frame(normal);
  const glm::vec2 shift = sampler.next_2d();
  const float height = PhotonMap::kDiscThickness * radius;
  int met = 0;
  for (int i = 0; i < kRays; ++i) {
    const float step = static_cast<float>(i) / kRays;
    const glm::vec2 u{shift.x + step, shift.y + kSecondStep * step};
    const glm::vec2 place = radius * sample_disk({u.x - std::floor(u.x), u.y - std::floor(u.y)});
    const Ray ray{point + frame * glm::vec3{place, height}, -normal};
    const std::optional<TriangleHit> hit = world.tracer.closest_triangle(ray);
    if (!hit || hit->t > 2.0f * height) continue;
    const glm::vec3 front = glm::normalize(world.flat.area_normal(hit->triangle));
    if (std::abs(glm::dot(front, normal)) >= PhotonMap::kLeastNormalCosine) ++met;
  }
  // The point itself is on surface.
  return static_cast<float>(std::max(met, 1)) / kRays;
}

}  // namespace lightwell
