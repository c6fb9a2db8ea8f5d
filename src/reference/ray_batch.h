// Many rays at once, on all cores: the oracle and the yardstick of other ray tracers.
#pragma once

#include <cstdint>
#include <span>

#include <glm/ext/vector_float3.hpp>

#include "reference/ray_tracer.h"

namespace lightwell {

struct BatchRay {
  glm::vec3 origin{0.0f};
  glm::vec3 direction{0.0f};
  float t_max = 0.0f;
};

enum class BatchQuery : std::uint8_t { kAnyHit, kClosestHit };

// One call of Embree a ray. Returns how many met something.
std::size_t trace_batch(const RayTracer& tracer, std::span<const BatchRay> rays, BatchQuery query);

}  // namespace lightwell
