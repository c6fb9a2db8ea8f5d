#include "passes/lights/light_table.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

#include "shaders/lights.h"

namespace lightwell {
namespace {

bool same_light(const WorldLight& a, const WorldLight& b) {
  return std::tie(a.type, a.position, a.direction, a.intensity, a.cos_inner, a.cos_outer, a.range) ==
         std::tie(b.type, b.position, b.direction, b.intensity, b.cos_inner, b.cos_outer, b.range);
}

glsl::GpuLight to_gpu_light(const WorldLight& light) {
  static_assert(static_cast<std::uint32_t>(LightType::kPoint) == glsl::kLightPoint &&
                static_cast<std::uint32_t>(LightType::kSpot) == glsl::kLightSpot &&
                static_cast<std::uint32_t>(LightType::kDirectional) == glsl::kLightDirectional);
  return {.position = light.position,
          .type = static_cast<std::uint32_t>(light.type),
          .direction = light.direction,
          .cos_inner = light.cos_inner,
          .intensity = light.intensity,
          .cos_outer = light.cos_outer,
          .unused = glm::vec3(0.0f),
          .inverse_range = light.type == LightType::kDirectional ? 0.0f : 1.0f / light.range};
}

}  // namespace

void LightTable::notice_changes(std::span<const WorldLight> lights) {
  const std::uint64_t next = revision_ + 1;
  if (lights.size() != lights_.size()) revision_ = next;
  revisions_.resize(lights.size(), next);
  for (std::size_t i = 0; i < std::min(lights.size(), lights_.size()); ++i)
    if (!same_light(lights[i], lights_[i])) revision_ = revisions_[i] = next;
  if (revision_ == next) lights_.assign(lights.begin(), lights.end());
}

LightTable::Frame LightTable::record(FrameGraph& graph, std::span<const WorldLight> lights) {
  notice_changes(lights);
  std::vector<glsl::GpuLight> elements;
  for (const WorldLight& light : lights_) elements.push_back(to_gpu_light(light));
  return {.lights = graph.upload<glsl::GpuLight>("lights", elements),
          .count = static_cast<std::uint32_t>(elements.size()),
          .revision = revision_,
          .world = lights_,
          .revisions = revisions_};
}

}  // namespace lightwell
