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

// ---- scenes with a large ground ----

// Boxes of triangles, and a sun.
struct GroundScene {
  Scene scene;
  void add_box(const glm::vec3& low, const glm::vec3& high);
  void add_ground(float side) { add_box({-0.5f * side, -0.5f, -0.5f * side}, {0.5f * side, 0.0f, 0.5f * side}); }
};

void GroundScene::add_box(const glm::vec3& low, const glm::vec3& high) {
  if (scene.materials.empty()) scene.materials.emplace_back();
  Primitive box;
  box.material = 0;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const auto first = static_cast<std::uint32_t>(box.positions.size());
    for (int corner = 0; corner < 4; ++corner) {
      glm::bvec3 is_high(false);
      is_high[axis] = face % 2 == 1;
      is_high[(axis + 1) % 3] = corner % 2 == 1;
      is_high[(axis + 2) % 3] = corner / 2 == 1;
      box.positions.push_back(glm::mix(low, high, glm::vec3(is_high)));
      glm::vec3 normal(0.0f);
      normal[axis] = face % 2 == 1 ? 1.0f : -1.0f;
      box.normals.push_back(normal);
    }
    const std::uint32_t turned = face % 2 == 0 ? 1 : 0;
    for (const std::uint32_t i : {0u, 1u + turned, 2u - turned, 3u, 2u - turned, 1u + turned})
      box.indices.push_back(first + i);
  }
  Mesh mesh;
  mesh.primitives.push_back(box);
  scene.meshes.push_back(mesh);
  Node node;
  node.mesh = static_cast<int>(scene.meshes.size()) - 1;
  scene.nodes.push_back(node);
}

WorldLight make_sun(const glm::vec3& direction) {
  WorldLight sun;
  sun.type = LightType::kDirectional;
  sun.direction = glm::normalize(direction);
  sun.intensity = glm::vec3(10.0f);
  return sun;
}

class LargeGroundTest : public DeviceTest, public ::testing::WithParamInterface<float> {
 protected:
  Image direct_light(const Scene& scene, const WorldLight& light, const WorldCamera& camera, int side = 64) {
    SceneSnapshot snapshot = take_snapshot(scene);
    snapshot.lights = {light};
    RendererOptions options;
    options.width = side;
    options.height = side;
    options.samples = 1;
    return Renderer(device(), scene, snapshot, options).render({&snapshot, camera}).direct;
  }
};

TEST_P(LargeGroundTest, NoSunShinesIntoASealedRoom) {
  GroundScene room;
  room.add_ground(GetParam());
  for (const glm::vec3& place : {glm::vec3(0.0f), glm::vec3(0.37f, 0.0f, -0.21f) * GetParam()}) {
    room.add_box(place + glm::vec3(-2.2f, -0.1f, -2.2f), place + glm::vec3(2.2f, 0.1f, 2.2f));
    room.add_box(place + glm::vec3(-2.2f, 3.0f, -2.2f), place + glm::vec3(2.2f, 3.2f, 2.2f));
    room.add_box(place + glm::vec3(-2.2f, 0.0f, -2.2f), place + glm::vec3(-2.0f, 3.2f, 2.2f));
    room.add_box(place + glm::vec3(2.0f, 0.0f, -2.2f), place + glm::vec3(2.2f, 3.2f, 2.2f));
    room.add_box(place + glm::vec3(-2.2f, 0.0f, -2.2f), place + glm::vec3(2.2f, 3.2f, -2.0f));
    room.add_box(place + glm::vec3(-2.2f, 0.0f, 2.0f), place + glm::vec3(2.2f, 3.2f, 2.2f));
    WorldCamera camera;
    camera.position = place + glm::vec3(-1.7f, 1.6f, 1.7f);
    camera.forward = glm::normalize(glm::vec3(1.0f, -0.1f, -1.0f));
    camera.yfov = 1.6f;
    for (const glm::vec3& direction : {glm::vec3(0.3f, -0.5f, 0.6f), glm::vec3(-0.9f, -0.2f, 0.3f)}) {
      const Image light = direct_light(room.scene, make_sun(direction), camera);
      for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) ASSERT_EQ(luminance_at(light, x, y), 0.0f) << x << ", " << y;
    }
  }
}

// A wide post of 1 m under a sun at 45 degrees: its shadow ends 1 m behind it. The camera looks down from above it, 1 m
// wide in 256 pixels.
TEST_P(LargeGroundTest, AShadowEndsWhereItShould) {
  GroundScene scene;
  scene.add_ground(GetParam());
  const glm::vec3 foot = glm::vec3(0.31f, 0.0f, 0.17f) * GetParam();
  scene.add_box(foot + glm::vec3(-0.1f, 0.0f, -1.0f), foot + glm::vec3(0.0f, 1.0f, 1.0f));
  WorldCamera camera;
  camera.position = foot + glm::vec3(1.0f, 2.0f, 0.0f);
  camera.forward = {0.0f, -1.0f, 0.0f};
  camera.up = {0.0f, 0.0f, 1.0f};
  camera.yfov = 2.0f * std::atan(0.25f);
  for (const bool is_sun : {true, false}) {
    SCOPED_TRACE(is_sun ? "sun" : "lamp far away");
    WorldLight light = make_sun({1.0f, -1.0f, 0.0f});
    if (!is_sun) {
      const float distance = 4.0f * GetParam();
      light.type = LightType::kPoint;
      light.position = foot + glm::vec3(0, 1, 0) - distance * light.direction;
      light.intensity *= distance * distance;
    }
    const Image image = direct_light(scene.scene, light, camera, 256);
    const float lit = std::max(luminance_at(image, 2, 128), luminance_at(image, 253, 128));
    ASSERT_GT(lit, 1.0f);
    double bright = 0.0;  // part of the row
    for (int x = 0; x < 256; ++x) bright += luminance_at(image, x, 128) / lit / 256.0;
    RecordProperty(is_sun ? "sun_edge" : "lamp_edge", std::to_string(bright));
    EXPECT_NEAR(bright, 0.5, 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(Metres, LargeGroundTest, ::testing::Values(10.0f, 80.0f, 1000.0f, 10000.0f));

INSTANTIATE_TEST_SUITE_P(Metres, ScaleTest, ::testing::Values(1e-6f, 1e-4f, 1e3f, 1e6f));

}  // namespace
}  // namespace lightwell
