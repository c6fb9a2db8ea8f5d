// Direct light of the GPU frame against the path tracer, on the built-in scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "graph/testing/device_test.h"
#include "lightwell/metrics.h"
#include "lightwell/path_tracer.h"
#include "lightwell/renderer.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

constexpr int kSide = 256;

float luminance(const Image& image, int x, int y) {
  const float* rgb = image.at(x, y);
  return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
}

// Whether the reference jumps within three pixels: an edge, or the border of a shadow.
bool is_near_jump(const Image& reference, int x, int y) {
  const float here = luminance(reference, x, y);
  for (int j = std::max(y - 3, 0); j <= std::min(y + 3, kSide - 1); ++j) {
    for (int i = std::max(x - 3, 0); i <= std::min(x + 3, kSide - 1); ++i) {
      const float there = luminance(reference, i, j);
      if (std::abs(there - here) > 0.15f * std::max(here, there)) return true;
    }
  }
  return false;
}

// Part of the pixels away from jumps that are within 1 % of the reference.
double part_within_one_percent(const Image& test, const Image& reference) {
  int counted = 0;
  int good = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (luminance(reference, x, y) == 0.0f || is_near_jump(reference, x, y)) continue;
      ++counted;
      good +=
          std::abs(luminance(test, x, y) - luminance(reference, x, y)) <= 0.01f * luminance(reference, x, y) ? 1 : 0;
    }
  }
  return counted > 0 ? static_cast<double>(good) / counted : 1.0;
}

// Only lights: the frame by itself knows neither emitters' nor the environment's light.
Scene load_lights_only(const std::string& name) {
  Scene scene = load_scene(resolve_scene(name));
  for (Material& material : scene.materials) material.emission = glm::vec3(0.0f);
  scene.environment = {};
  return scene;
}

class DirectLightTest : public DeviceTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(DirectLightTest, IsThePathTracers) {
  const Scene scene = load_lights_only(GetParam());
  const SceneSnapshot snapshot = take_snapshot(scene);
  ASSERT_FALSE(snapshot.lights.empty());
  const WorldCamera camera = snapshot.cameras.at(0);

  PathTracerOptions tracer;
  tracer.width = kSide;
  tracer.height = kSide;
  tracer.samples = 64;
  tracer.max_bounces = 0;
  const Picture reference = PathTracer(scene, snapshot).render(camera, tracer);
  RendererOptions options;
  options.width = kSide;
  options.height = kSide;
  options.samples = 16;
  const Picture picture = Renderer(device(), scene, snapshot, options).render({&snapshot, camera});

  const Metrics direct = compute_metrics(picture.direct, reference.direct);
  const double good = part_within_one_percent(picture.direct, reference.direct);
  RecordProperty("energy", std::to_string(direct.energy));
  RecordProperty("ssim", std::to_string(direct.ssim));
  RecordProperty("within_one_percent", std::to_string(good));
  EXPECT_GT(direct.mean_reference, 0.0);
  EXPECT_NEAR(direct.energy, 1.0, 0.005);
  EXPECT_GE(direct.ssim, 0.97);
  EXPECT_GE(good, 0.95);
  EXPECT_NEAR(compute_metrics(picture.albedo, reference.albedo).energy, 1.0, 0.005);
  EXPECT_GE(compute_metrics(picture.albedo, reference.albedo).ssim, 0.97);
}

INSTANTIATE_TEST_SUITE_P(Scenes, DirectLightTest,
                         ::testing::Values("cornell-spot", "boxes", "room", "two-rooms", "sphere", "arena", "corridor",
                                           "textured"));

}  // namespace
}  // namespace lightwell
