// What photons carry, and where to, against closed forms for every kind of light.
#include "reference/photon_sources.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "reference/test_scenes.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kPhotons = 1u << 16;
constexpr std::uint32_t kSeed = 5;
constexpr double kTolerance = 0.01;
constexpr double kExactPi = std::numbers::pi;

// Mean flux of those photons that meet a surface.
glm::dvec3 arriving_flux(const TestScene& scene) {
  const TracedWorld world(scene.scene, scene.snapshot);
  const PhotonSources sources(world);
  glm::dvec3 sum{0.0};
  for (std::uint32_t i = 0; i < kPhotons; ++i) {
    Sampler sampler(kSeed, 0, i);
    const PhotonStart start = sources.emit(sampler);
    EXPECT_NEAR(glm::length(start.ray.direction), 1.0f, 1e-4f);
    if (world.tracer.closest_triangle(start.ray)) sum += glm::dvec3(start.flux);
  }
  return sum / double{kPhotons};
}

void expect_flux(const TestScene& scene, const glm::dvec3& expected) {
  const glm::dvec3 flux = arriving_flux(scene);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux[c], expected[c], kTolerance * expected[c]) << "channel " << c;
}

struct Box : TestScene {
  Box() { add_box_seen_from_inside({0, 0, 0}, 2.0f, add_material(glm::vec3{0.5f})); }
};

// A ball of radius 1; from any side a disc of area pi.
struct Ball : TestScene {
  Ball() { add_sphere({3, 1, -2}, 1.0f, 128, false, add_material(glm::vec3{0.5f})); }
};

WorldLight spot_light() {
  WorldLight spot{LightType::kSpot, {0.1f, 0.2f, -0.3f}, glm::normalize(glm::vec3{1, -2, 0.5f}), {1, 2, 3}};
  spot.cos_inner = std::cos(0.3f);
  spot.cos_outer = std::cos(0.9f);
  return spot;
}

double spot_sr(const WorldLight& spot) {
  const double inner = double{spot.cos_inner}, outer = double{spot.cos_outer};
  return 2.0 * kExactPi * (1.0 - inner + (inner - outer) / 3.0);
}

TEST(PhotonSources, PointLight) {
  Box box;
  box.snapshot.lights.push_back({LightType::kPoint, {0.3f, -0.5f, 0.2f}, {0, 0, -1}, {1, 2, 3}, 1.0f, 0.0f});
  expect_flux(box, 4.0 * kExactPi * glm::dvec3(1, 2, 3));
}

TEST(PhotonSources, SpotLight) {
  Box box;
  box.snapshot.lights.push_back(spot_light());
  expect_flux(box, spot_sr(spot_light()) * glm::dvec3(1, 2, 3));
}

// Flux by the cosine to the axis, in 16 bins between the cones and one within the inner one.
TEST(PhotonSources, SpotLightFallsOffAsTheSquareOfT) {
  constexpr int kBins = 16;
  Box box;
  const WorldLight spot = spot_light();
  box.snapshot.lights.push_back(spot);
  const TracedWorld world(box.scene, box.snapshot);
  const PhotonSources sources(world);
  std::vector<double> flux(kBins + 1);
  for (std::uint32_t i = 0; i < kPhotons; ++i) {
    Sampler sampler(kSeed, 0, i);
    const PhotonStart start = sources.emit(sampler);
    const float t =
        (glm::dot(start.ray.direction, spot.direction) - spot.cos_outer) / (spot.cos_inner - spot.cos_outer);
    ASSERT_GT(t, -1e-4f);
    flux[static_cast<std::size_t>(std::clamp(t * kBins, 0.0f, float{kBins}))] += double{start.flux.r} / kPhotons;
  }
  const double between = 2.0 * kExactPi * double{spot.cos_inner - spot.cos_outer};
  const double inside = 2.0 * kExactPi * (1.0 - double{spot.cos_inner});
  EXPECT_NEAR(flux[kBins], inside, kTolerance * inside);
  for (int bin = 0; bin < kBins; ++bin) {
    const double expected = between * (std::pow(bin + 1, 3) - std::pow(bin, 3)) / (3.0 * std::pow(kBins, 3));
    EXPECT_NEAR(flux[static_cast<std::size_t>(bin)], expected, 0.03 * expected + 1e-3 * between) << "bin " << bin;
  }
}

TEST(PhotonSources, Sun) {
  Ball ball;
  ball.snapshot.lights.push_back(
      {LightType::kDirectional, {0, 0, 0}, glm::normalize(glm::vec3{1, -2, 0.3f}), {1, 2, 3}, 1.0f, 0.0f});
  expect_flux(ball, kExactPi * glm::dvec3(1, 2, 3));
}

// Along an axis one face of the box is all that light meets.
TEST(PhotonSources, SunStraightDown) {
  TestScene plane;
  plane.add_quad({-1, 0, -1}, {0, 0, 2}, {3, 0, 0}, plane.add_material(glm::vec3{1.0f}));
  plane.snapshot.lights.push_back({LightType::kDirectional, {0, 0, 0}, {0, -1, 0}, {1, 2, 3}, 1.0f, 0.0f});
  expect_flux(plane, 6.0 * glm::dvec3(1, 2, 3));
}

TEST(PhotonSources, ConstantEnvironment) {
  Ball ball;
  ball.scene.environment.radiance = {1, 2, 3};
  expect_flux(ball, 4.0 * kExactPi * kExactPi * glm::dvec3(1, 2, 3));
}

TEST(PhotonSources, EnvironmentMap) {
  Ball ball;
  ball.scene.environment.radiance = {1, 2, 3};
  Image& map = ball.scene.environment.map;
  map = Image(8, 4, 3);
  for (std::size_t i = 0; i < map.pixels.size(); ++i) map.pixels[i] = i / 3 % 5 == 0 ? 20.0f : 0.5f;
  // The ball catches pi L d omega.
  const EnvironmentLight environment(ball.scene.environment);
  constexpr int kRows = 512;
  glm::dvec3 expected{0.0};
  for (int i = 0; i < kRows; ++i) {
    for (int j = 0; j < 2 * kRows; ++j) {
      const double theta = kExactPi * (i + 0.5) / kRows, phi = kExactPi * (j + 0.5) / kRows;
      const glm::dvec3 direction{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
      expected += glm::dvec3(environment.radiance(glm::vec3(direction))) * std::sin(theta);
    }
  }
  expect_flux(ball, expected * std::pow(kExactPi, 3) / (kRows * double{kRows}));
}

TEST(PhotonSources, EmissiveTriangles) {
  for (const bool double_sided : {false, true}) {
    Box box;
    const int light = box.add_material(glm::vec3{0.0f}, {1, 2, 3});
    box.scene.materials.back().double_sided = double_sided;
    box.add_quad({-1, 0.5f, -0.5f}, {2, 0, 0}, {0, 0, 1}, light);
    box.add_quad({-1, -0.5f, -0.5f}, {0.5f, 0, 0}, {0, 1, 0}, light);
    expect_flux(box, (double_sided ? 2.0 : 1.0) * kExactPi * 2.5 * glm::dvec3(1, 2, 3));
  }
}

// Texels of radiance 1 and 0: half of the light, and none from the dark half.
TEST(PhotonSources, TexturedEmitter) {
  Box box;
  const int light = box.add_material(glm::vec3{0.0f}, {1, 2, 3});
  box.scene.materials.back().emission_texture.texture = box.add_texture({255, 255, 255, 255, 0, 0, 0, 255}, true);
  box.add_quad({-1, 0.5f, -0.5f}, {2, 0, 0}, {0, 0, 1}, light);
  expect_flux(box, kExactPi * glm::dvec3(1, 2, 3));
  const TracedWorld world(box.scene, box.snapshot);
  const PhotonSources sources(world);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    Sampler sampler(kSeed, 0, i);
    const PhotonStart start = sources.emit(sampler);
    EXPECT_TRUE(start.ray.origin.x <= 0.0f || start.flux == glm::vec3{0.0f});
  }
}

// All kinds together, of very different power.
TEST(PhotonSources, AddUp) {
  Box box;
  box.snapshot.lights.push_back({LightType::kPoint, {0, 0, 0}, {0, 0, -1}, {1, 2, 3}, 1.0f, 0.0f});
  box.snapshot.lights.push_back({LightType::kPoint, {1, 0, 0}, {0, 0, -1}, {0.01f, 0.02f, 0.03f}, 1.0f, 0.0f});
  box.snapshot.lights.push_back(spot_light());
  box.add_quad({-1, 0.5f, -0.5f}, {2, 0, 0}, {0, 0, 1}, box.add_material(glm::vec3{0.0f}, {1, 2, 3}));
  // The box's backs reflect, too: what comes from outside meets its 24 m^2 of walls.
  box.scene.environment.radiance = {1, 2, 3};
  const double factor = 4.0 * kExactPi * 1.01 + spot_sr(spot_light()) + kExactPi * 2.0 + kExactPi * 6.0 * 16.0;
  expect_flux(box, factor * glm::dvec3(1, 2, 3));
}

TEST(PhotonSources, NothingShines) {
  Box box;
  box.snapshot.lights.push_back({LightType::kPoint, {0, 0, 0}, {0, 0, -1}, {0, 0, 0}, 1.0f, 0.0f});
  EXPECT_TRUE(PhotonSources(TracedWorld(box.scene, box.snapshot)).empty());
}

// There is nothing for light to meet.
TEST(PhotonSources, EmptyScene) {
  TestScene empty;
  empty.scene.environment.radiance = {1, 2, 3};
  EXPECT_TRUE(PhotonSources(TracedWorld(empty.scene, empty.snapshot)).empty());
}

}  // namespace
}  // namespace lightwell
