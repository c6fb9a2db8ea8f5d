// Motion vectors of the G-buffer against points that the processor follows from frame to frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>
#include <vector>

#include <glm/geometric.hpp>

#include "animated_scene.h"
#include "graph/testing/device_test.h"
#include "lightwell/renderer.h"
#include "reference/ray_tracer.h"

namespace lightwell {
namespace {

constexpr int kSide = 128;  // pixels

struct Case {
  const char* name;
  int last_frame, frame;
  bool camera_moves;
};

// The test's name.
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class PinholeView {
 public:
  explicit PinholeView(const WorldCamera& camera)
      : camera_(camera), right_(glm::cross(camera.forward, camera.up)), scale_(std::tan(0.5f * camera.yfov)) {}

  // In pixels from the upper left corner.
  glm::vec2 project(const glm::vec3& point) const {
    const glm::vec3 d = point - camera_.position;
    const glm::vec2 on_plane =
        glm::vec2(glm::dot(d, right_), -glm::dot(d, camera_.up)) / (glm::dot(d, camera_.forward) * scale_);
    return 0.5f * static_cast<float>(kSide) * (on_plane + 1.0f);
  }

  Ray ray(const glm::vec2& place) const {
    const glm::vec2 on_plane = (2.0f * place / static_cast<float>(kSide) - 1.0f) * scale_;
    return {camera_.position, camera_.forward + on_plane.x * right_ - on_plane.y * camera_.up};
  }

 private:
  WorldCamera camera_;
  glm::vec3 right_;
  float scale_;  // of half the picture at distance 1
};

// Weights of a triangle's second and third corner at a point of it.
glm::vec2 barycentrics(const FlatScene& flat, std::size_t triangle, const glm::vec3& point) {
  const glm::dvec3 a(flat.corner(triangle, 0).position);
  const glm::dvec3 u = glm::dvec3(flat.corner(triangle, 1).position) - a;
  const glm::dvec3 v = glm::dvec3(flat.corner(triangle, 2).position) - a;
  const glm::dvec3 p = glm::dvec3(point) - a, n = glm::cross(u, v);
  return {static_cast<float>(glm::dot(glm::cross(p, v), n) / glm::dot(n, n)),
          static_cast<float>(glm::dot(glm::cross(u, p), n) / glm::dot(n, n))};
}

class MotionTest : public DeviceTest, public ::testing::WithParamInterface<Case> {};

TEST_P(MotionTest, IsThatOfThePointInThePixel) {
  const Case& c = GetParam();
  const AnimatedScene animated;
  const SceneSnapshot last = animated.frame(c.last_frame), now = animated.frame(c.frame);
  WorldCamera last_camera = now.cameras.at(0);
  if (c.camera_moves) {
    last_camera.position += glm::vec3(0.02f, -0.01f, 0.03f);
    last_camera.forward = glm::normalize(last_camera.forward + glm::vec3(0.01f, 0.02f, 0.0f));
    last_camera.up =
        glm::normalize(last_camera.up - glm::dot(last_camera.up, last_camera.forward) * last_camera.forward);
  }
  RendererOptions options;
  options.width = options.height = kSide;
  options.samples = options.frames = 1;
  options.debug_views = {"motion"};
  Renderer renderer(device(), animated.scene(), last, options);
  renderer.render({&last, last_camera});
  renderer.render({&now, now.cameras.at(0)});
  const Image& motion = renderer.debug_images().at("motion");

  // The same triangles at both moments; flatten() leaves out those without area, which only the first list's vertices
  // do not know.
  const FlatScene flat = flatten(animated.scene(), now), last_flat = flatten(animated.scene(), last);
  ASSERT_EQ(flat.vertices.size(), last_flat.vertices.size());
  const RayTracer tracer(flat);
  const PinholeView view(now.cameras.at(0)), last_view(last_camera);
  std::vector<std::optional<Surface>> seen;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) seen.push_back(tracer.closest(view.ray(glm::vec2(x, y) + 0.5f)));
  const auto at = [&](int x, int y) -> const std::optional<Surface>& {
    return seen[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)];
  };
  // An edge: the rasteriser, whose corners are rounded to a fraction of a pixel, may see another surface.
  const auto is_near_edge = [&](int x, int y) {
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const std::optional<Surface>& other = at(x + i, y + j);
        if (!other || glm::distance(other->position, at(x, y)->position) > 0.03f) return true;
      }
    return false;
  };
  // The same where surfaces touch. Corners are rounded by at most 1/16 of a pixel (Vulkan 1.3, subPixelPrecisionBits).
  const auto is_on_border = [&](int x, int y) {
    for (const glm::vec2& offset : {glm::vec2{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}) {
      const std::optional<Surface> other = tracer.closest(view.ray(glm::vec2(x, y) + 0.5f + 0.125f * offset));
      if (!other || flat.triangles[other->triangle].material != flat.triangles[at(x, y)->triangle].material)
        return true;
    }
    return false;
  };

  int counted = 0, moved = 0;
  float worst = 0.0f;
  for (int y = 1; y < kSide - 1; ++y) {
    for (int x = 1; x < kSide - 1; ++x) {
      if (!at(x, y) || is_near_edge(x, y) || is_on_border(x, y)) continue;
      const Surface& surface = *at(x, y);
      const glm::vec2 weights = barycentrics(flat, surface.triangle, surface.position);
      const auto& corners = flat.triangles[surface.triangle].vertices;
      const glm::vec3 last_position = (1.0f - weights.x - weights.y) * last_flat.vertices[corners[0]].position +
                                      weights.x * last_flat.vertices[corners[1]].position +
                                      weights.y * last_flat.vertices[corners[2]].position;
      const glm::vec2 expected = glm::vec2(x, y) + 0.5f - last_view.project(last_position);
      const glm::vec2 error = glm::vec2(motion.at(x, y)[0], motion.at(x, y)[1]) - expected;
      ++counted;
      moved += glm::length(expected) > 0.25f ? 1 : 0;
      worst = std::max(worst, glm::length(error));
      EXPECT_LT(glm::length(error), 0.05f) << "pixel " << x << ", " << y << ": " << expected.x << ", " << expected.y;
    }
  }
  EXPECT_GT(counted, 3000);
  EXPECT_GT(moved, 100);
}

INSTANTIATE_TEST_SUITE_P(Cases, MotionTest,
                         ::testing::Values(Case{"objects", 8, 9, false}, Case{"camera", 9, 9, true},
                                           Case{"both", 30, 31, true}),
                         ::testing::PrintToStringParamName());

}  // namespace
}  // namespace lightwell
