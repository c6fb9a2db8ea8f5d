#include "reference/reflected_flux.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/test_scenes.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSamples = 1u << 16;
constexpr std::uint32_t kSeed = 3;

void expect_flux(const glm::dvec3& flux, const glm::dvec3& expected) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux[c], expected[c], 0.005 * expected[c]) << "channel " << c;
}

// A closed box of albedo rho that emits 1: irradiance after k bounces is pi rho^(k - 1) at every point.
TEST(ReflectedFlux, OfAFurnaceIsAGeometricSeries) {
  const glm::dvec3 albedo{0.5, 0.2, 0.8};
  TestScene box;
  box.add_box_seen_from_inside({1, 2, 3}, 1.5f, box.add_material(glm::vec3(albedo), glm::vec3(1.0f)));
  const ReflectedFlux flux = integrate_reflected_flux(box.scene, box.snapshot, 3, kSamples, kSeed);
  const double emitted = std::numbers::pi * 6.0 * 9.0;
  expect_flux(flux.first, emitted * albedo);
  expect_flux(flux.further, emitted * albedo * albedo * (1.0 + albedo));
}

// All that a point light sends meets the walls, whose fronts or backs it sees.
TEST(ReflectedFlux, OfAPointLightInABoxIsItsOwn) {
  const glm::dvec3 albedo{0.5, 0.2, 0.8};
  TestScene box;
  box.add_box_seen_from_inside({0, 0, 0}, 1.0f, box.add_material(glm::vec3(albedo)));
  WorldLight light;
  light.position = {0.2f, -0.3f, 0.1f};
  light.intensity = {1, 2, 3};
  box.snapshot.lights.push_back(light);
  const ReflectedFlux flux = integrate_reflected_flux(box.scene, box.snapshot, 2, kSamples, kSeed);
  const glm::dvec3 sent = 4.0 * std::numbers::pi * glm::dvec3(light.intensity);
  expect_flux(flux.first, sent * albedo);
  expect_flux(flux.further, sent * albedo * albedo);
}

}  // namespace
}  // namespace lightwell
