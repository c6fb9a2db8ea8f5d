// The tracing hierarchy follows what moves: rays against Embree's, after the frames before.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "animated_scene.h"
#include "passes/trace/testing/trace_test_base.h"
#include "reference/ray_tracer.h"

namespace lightwell {
namespace {

constexpr unsigned kSeed = 7;
constexpr std::size_t kRays = 20000;

// From anywhere in the bounds towards anywhere in them.
std::vector<glsl::ListedRay> make_rays(const Bounds& bounds) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  const auto point = [&] {
    const float x = uniform(random), y = uniform(random), z = uniform(random);
    return glm::mix(bounds.minimum, bounds.maximum, glm::vec3(x, y, z));
  };
  std::vector<glsl::ListedRay> rays(kRays);
  for (glsl::ListedRay& ray : rays) {
    ray.origin = point();
    ray.t_min = 0.0f;
    ray.direction = glm::normalize(point() - ray.origin);
    ray.t_max = std::numeric_limits<float>::infinity();
  }
  return rays;
}

using AnimationTracingTest = TraceTest;

TEST_F(AnimationTracingTest, FollowsWhatMoves) {
  const AnimatedScene animated;
  const std::vector<glsl::ListedRay> rays = make_rays(animated.frame(0).bounds);
  Traced traced(animated.scene(), animated.frame(0));
  // One after the other, then a jump to where everything is somewhere else.
  for (const int frame : {0, 1, 2, 3, 4, 24}) {
    const SceneSnapshot now = animated.frame(frame);
    const std::vector<glsl::ListedHit> found = trace(traced, now, rays);
    const FlatScene flat = flatten(animated.scene(), now);
    const RayTracer embree(flat);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const std::optional<TriangleHit> expected = embree.closest_triangle({rays[i].origin, rays[i].direction});
      const bool met = found[i].triangle != 0xffffffffu;
      const bool same = met == expected.has_value() && (!met || std::abs(found[i].t - expected->t) < 1e-5f);
      differ += same ? 0 : 1;
    }
    // Rays that graze an outline may pass it on either side: both poses are rounded.
    EXPECT_LE(differ, kRays / 2000) << "frame " << frame << ", seed " << kSeed;
  }
}

}  // namespace
}  // namespace lightwell
