// Times of the view's passes; run by hand.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <random>
#include <string>

#include "techniques/photon_splatting/splat_test_screen.h"

namespace lightwell {
namespace {

TestHit cube(const glm::vec3& origin, const glm::vec3& direction) {
  TestHit hit;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0f) continue;
    const float distance = (sign_of(direction[axis]) - origin[axis]) / direction[axis];
    if (distance > 0.0f && (hit.distance == 0.0f || distance < hit.distance)) {
      hit = {distance, glm::vec3(0.0f)};
      hit.normal[axis] = -sign_of(direction[axis]);
    }
  }
  return hit;
}

class SplatBench : public SplatTest {};

TEST_F(SplatBench, DISABLED_TimesOfPasses) {
  WorldCamera camera;
  camera.position = {0.0f, -0.95f, 0.0f};
  camera.forward = {0.0f, 1.0f, 0.0f};
  camera.up = {0.0f, 0.0f, 1.0f};
  camera.yfov = 1.4f;
  camera.znear = 0.01f;
  const TestScreen screen({256, 256}, camera, cube);
  for (const auto& [count, width] : {std::pair{25000, 0.05f}, {2500, 0.15f}, {100000, 0.025f}}) {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    TestSplats splats(cube);
    for (int i = 0; i < count; ++i) {
      const glm::vec3 direction = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
      const glm::vec3 origin = 0.5f * glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
      const TestHit hit = cube(origin, direction);
      splats.add(make_splat(origin + hit.distance * direction, direction, width, hit.normal));
    }
    for (const SplatEstimate estimate : {SplatEstimate::kMean, SplatEstimate::kDensity}) {
      std::map<std::string, double> times;
      for (int frame = 0; frame < 5; ++frame) {
        gather(screen, splats, {.estimate = estimate}, 64 << 20);
        if (frame == 0) continue;
        std::map<std::string, double> now;
        for (const PassTime& pass : executor().pass_times(frame_)) now[pass.name] += pass.time_ms;
        for (const auto& [name, ms] : now) times[name] = times.contains(name) ? std::min(times[name], ms) : ms;
      }
      std::printf("%d splats of half width %g, estimate %u: %u entries\n", count, width,
                  static_cast<unsigned>(estimate), total_.x);
      for (const auto& [name, ms] : times)
        if (name.starts_with("splats")) std::printf("  %-20s %8.2f ms\n", name.c_str(), ms);
    }
  }
}

}  // namespace
}  // namespace lightwell
