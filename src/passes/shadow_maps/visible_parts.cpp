#include "passes/shadow_maps/visible_parts.h"

#include <algorithm>
#include <array>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "passes/shadow_maps/shadow_views.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kIndicesWorthADraw = 3 * 256;

// Sums of a few products, here and in the vertex shader, each rounded to 6e-8.
constexpr float kRounding = 1e-5f;

// A point is outside where dot(plane.xyz, p) + plane.w < 0 for one of them:
// -w <= x <= w, -w <= y <= w, 0 <= z <= w in clip space (Gribb and Hartmann 2001).
std::array<glm::vec4, 6> list_planes(const glm::mat4& clip_from_world) {
  const glm::mat4 rows = glm::transpose(clip_from_world);
  return {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[2], rows[3] - rows[2]};
}

// False where rounding leaves a doubt, and for bounds that are not finite. `origin`: what the vertex shader subtracts
// from positions.
bool is_outside(const Bounds& bounds, const glm::vec4& plane, const glm::vec3& origin) {
  const glm::vec3 normal(plane);
  const glm::vec3 center = 0.5f * (bounds.minimum + bounds.maximum);
  const glm::vec3 half = 0.5f * (bounds.maximum - bounds.minimum);
  const glm::vec3 terms = glm::abs(center) + half + glm::abs(origin);
  const float slack = kRounding * (glm::dot(glm::abs(normal), terms) + std::abs(plane.w));
  return glm::dot(normal, center) + glm::dot(glm::abs(normal), half) + plane.w < -slack;
}

}  // namespace

std::vector<IndexRange> list_visible_ranges(std::span<const PartRange> parts, bool alpha_masked,
                                            const glsl::ShadowView& view, std::uint32_t face) {
  const std::array<glm::vec4, 6> planes = list_planes(clip_from_world(view, face));
  const glm::vec3 origin = view.kind == glsl::kShadowCube ? view.position : glm::vec3(0.0f);
  std::vector<IndexRange> ranges;
  for (const PartRange& part : parts) {
    if (part.has_holes != alpha_masked || std::any_of(planes.begin(), planes.end(), [&](const glm::vec4& plane) {
          return is_outside(part.world_bounds, plane, origin);
        }))
      continue;
    const std::uint32_t end = part.first_index + part.index_count;
    if (!ranges.empty() && part.first_index - (ranges.back().first + ranges.back().count) <= kIndicesWorthADraw)
      ranges.back().count = end - ranges.back().first;
    else
      ranges.push_back({part.first_index, part.index_count});
  }
  return ranges;
}

}  // namespace lightwell
