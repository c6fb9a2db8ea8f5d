#include "apps/cli/ray_lists.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "reference/random.h"
#include "reference/sampling.h"

namespace lightwell {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr int kTile = 8;

std::vector<BatchRay> make_camera_rays(const WorldCamera& camera, int count) {
  const int tiles = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)) / kTile));
  const float side = static_cast<float>(kTile * tiles);
  const float half = std::tan(0.5f * camera.yfov);
  const glm::vec3 right = glm::cross(camera.forward, camera.up);
  std::vector<BatchRay> rays;
  rays.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const int tile = i / (kTile * kTile);
    const float x = static_cast<float>(kTile * (tile % tiles) + i % kTile) + 0.5f;
    const float y = static_cast<float>(kTile * (tile / tiles) + i / kTile % kTile) + 0.5f;
    const glm::vec2 place = half * glm::vec2(2.0f * x / side - 1.0f, 1.0f - 2.0f * y / side);
    rays.push_back({camera.position, glm::normalize(camera.forward + place.x * right + place.y * camera.up), kFar});
  }
  return rays;
}

}  // namespace

std::vector<RayList> make_ray_lists(const WorldCamera& camera, const RayTracer& tracer, int count) {
  const std::vector<BatchRay> seen = make_camera_rays(camera, count);
  std::vector<BatchRay> ambient;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    const std::optional<Surface> surface = tracer.closest({seen[i].origin, seen[i].direction, 0.0f});
    if (!surface) continue;
    Sampler sampler(0, i, 0);
    const glm::mat3 frame = make_frame(surface->geometric_normal);
    ambient.push_back({surface->start(), frame * sample_cosine_hemisphere(sampler.next_2d()), kFar});
  }
  for (std::size_t i = 0; !ambient.empty() && ambient.size() < seen.size(); ++i) ambient.push_back(ambient[i]);
  return {{"camera", seen}, {"ambient", std::move(ambient)}};
}

}  // namespace lightwell
