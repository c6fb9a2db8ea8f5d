// Direct light of the GPU frame against the path tracer, on the built-in scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "core/luminance.h"
#include "graph/testing/device_test.h"
#include "lightwell/metrics.h"
#include "lightwell/path_tracer.h"
#include "lightwell/renderer.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

constexpr int kSide = 256;

float luminance_at(const Image& image, int x, int y) {
  const float* rgb = image.at(x, y);
  return luminance(glm::vec3(rgb[0], rgb[1], rgb[2]));
}

// Whether the reference jumps within three pixels: an edge, or the border of a shadow.
bool is_near_jump(const Image& reference, int x, int y) {
  const float here = luminance_at(reference, x, y);
  for (int j = std::max(y - 3, 0); j <= std::min(y + 3, kSide - 1); ++j) {
    for (int i = std::max(x - 3, 0); i <= std::min(x + 3, kSide - 1); ++i) {
      const float there = luminance_at(reference, i, j);
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
      if (luminance_at(reference, x, y) == 0.0f || is_near_jump(reference, x, y)) continue;
      ++counted;
      good +=
          std::abs(luminance_at(test, x, y) - luminance_at(reference, x, y)) <= 0.01f * luminance_at(reference, x, y)
              ? 1
              : 0;
    }
  }
  return counted > 0 ? static_cast<double>(good) / counted : 1.0;
}

// Only lights: the frame by itself knows neither emitters' nor the environment's light.
Scene load_lights_only(const std::string& name, float scale = 1.0f) {
  Scene scene = load_scene(resolve_scene(name), {.scale = scale});
  for (Material& material : scene.materials) material.emission = glm::vec3(0.0f);
  scene.environment = {};
  return scene;
}

class DirectLightTest : public DeviceTest {
 protected:
  void expect_the_path_tracers(const Scene& scene, const SceneSnapshot& snapshot);
};

void DirectLightTest::expect_the_path_tracers(const Scene& scene, const SceneSnapshot& snapshot) {
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
  for (const bool shadow_rays : {false, true}) {
    SCOPED_TRACE(shadow_rays ? "shadow rays" : "shadow maps");
    options.shadows = shadow_rays ? 1 : 0;
    const Picture picture = Renderer(device(), scene, snapshot, options).render({&snapshot, camera});
    const Metrics direct = compute_metrics(picture.direct, reference.direct);
    const double good = part_within_one_percent(picture.direct, reference.direct);
    const std::string name = shadow_rays ? "rays_" : "maps_";
    RecordProperty(name + "energy", std::to_string(direct.energy));
    RecordProperty(name + "ssim", std::to_string(direct.ssim));
    RecordProperty(name + "within_one_percent", std::to_string(good));
    EXPECT_GT(direct.mean_reference, 0.0);
    EXPECT_NEAR(direct.energy, 1.0, 0.005);
    EXPECT_GE(direct.ssim, 0.97);
    EXPECT_GE(good, 0.95);
    if (shadow_rays) continue;
    EXPECT_NEAR(compute_metrics(picture.albedo, reference.albedo).energy, 1.0, 0.005);
    EXPECT_GE(compute_metrics(picture.albedo, reference.albedo).ssim, 0.97);
  }
}

class DirectLightOfSceneTest : public DirectLightTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(DirectLightOfSceneTest, IsThePathTracers) {
  const Scene scene = load_lights_only(GetParam());
  const SceneSnapshot snapshot = take_snapshot(scene);
  ASSERT_FALSE(snapshot.lights.empty());
  expect_the_path_tracers(scene, snapshot);
}

INSTANTIATE_TEST_SUITE_P(Scenes, DirectLightOfSceneTest,
                         ::testing::Values("cornell-spot", "boxes", "room", "two-rooms", "sphere", "arena", "corridor",
                                           "textured"));

// A lamp or a wide spot so far away that the scene is a dot to it lights it as a sun would from there.
TEST_F(DirectLightTest, OfLightsFarAwayIsThePathTracers) {
  const Scene scene = load_lights_only("arena");
  SceneSnapshot snapshot = take_snapshot(scene);
  const Bounds& bounds = snapshot.bounds;
  const glm::vec3 middle = 0.5f * (bounds.minimum + bounds.maximum);
  const float distance = 40.0f * glm::distance(bounds.minimum, bounds.maximum);
  WorldLight light;
  light.direction = glm::normalize(glm::vec3(0.6f, -0.5f, -0.6f));
  light.position = middle - distance * light.direction;
  light.intensity = glm::vec3(distance * distance);
  light.cos_outer = 0.1f;
  for (const LightType type : {LightType::kPoint, LightType::kSpot}) {
    SCOPED_TRACE(type == LightType::kPoint ? "point" : "spot");
    light.type = type;
    snapshot.lights = {light};
    expect_the_path_tracers(scene, snapshot);
  }
}

class ScaleTest : public DeviceTest, public ::testing::WithParamInterface<float> {
 protected:
  Image direct_light(const std::string& name, float scale) {
    const Scene scene = load_lights_only(name, scale);
    const SceneSnapshot snapshot = take_snapshot(scene);
    RendererOptions options;
    options.width = 64;
    options.height = 64;
    return Renderer(device(), scene, snapshot, options).render({&snapshot, snapshot.cameras.at(0)}).direct;
  }
};

// No length is built in: from micrometres to megametres the picture is the same, but for the inverse square law.
TEST_P(ScaleTest, OnlyTheInverseSquareLawSeesIt) {
  const float scale = GetParam();
  Image spot = direct_light("cornell-spot", scale);
  for (float& value : spot.pixels) value *= scale * scale;
  const Metrics of_spot = compute_metrics(spot, direct_light("cornell-spot", 1.0f));
  EXPECT_NEAR(of_spot.energy, 1.0, 0.002);
  EXPECT_GE(of_spot.ssim, 0.99);
  const Metrics of_sun = compute_metrics(direct_light("arena", scale), direct_light("arena", 1.0f));
  EXPECT_NEAR(of_sun.energy, 1.0, 0.002);
  EXPECT_GE(of_sun.ssim, 0.99);
}

INSTANTIATE_TEST_SUITE_P(Metres, ScaleTest, ::testing::Values(1e-6f, 1e-4f, 1e3f, 1e6f));

}  // namespace
}  // namespace lightwell
