#include "reference/ray_batch.h"

#include <functional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace lightwell {

std::size_t trace_batch(const RayTracer& tracer, std::span<const BatchRay> rays, BatchQuery query) {
  const auto trace = [&](const tbb::blocked_range<std::size_t>& range, std::size_t count) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const BatchRay& ray = rays[i];
      if (query == BatchQuery::kAnyHit) {
        count += tracer.is_blocked(ray.origin, ray.direction, ray.t_max) ? 1 : 0;
      } else {
        const std::optional<TriangleHit> hit = tracer.closest_triangle({ray.origin, ray.direction, 0.0f});
        count += hit && hit->t <= ray.t_max ? 1 : 0;
      }
    }
    return count;
  };
  return tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, rays.size(), 1024), std::size_t{0}, trace,
                              std::plus<>());
}

}  // namespace lightwell
