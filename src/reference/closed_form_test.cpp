// The path tracer against scenes whose light is known exactly. Every mean must be within 1 %.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <ostream>

#include "core/log.h"
#include "reference/test_scenes.h"

namespace lightwell {
namespace {

constexpr double kTolerance = 0.01;

void expect_mean(const Image& image, double expected, const std::string& what) {
  const glm::dvec3 mean = mean_of(image);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], expected, kTolerance * expected) << what << ", channel " << c;
}

// Every pixel, for scenes whose light is the same everywhere. `tolerance` is relative.
void expect_uniform(const Image& image, double expected, double tolerance, const std::string& what) {
  double worst = 0.0;
  for (const float value : image.pixels) worst = std::max(worst, std::abs(static_cast<double>(value) - expected));
  EXPECT_LE(worst, tolerance * expected) << what;
}

// Albedo rho and emission 1 everywhere: sum of rho^k for k = 0 (emission), 1 (direct), 2.. (indirect).
struct BoxPlace {
  float half;
  glm::vec3 center;
};

void PrintTo(const BoxPlace& place, std::ostream* out) {
  *out << "half side " << place.half << " m at x " << place.center.x << " m";
}

class ClosedBox : public testing::TestWithParam<BoxPlace> {};

// The series 1 / (1 - albedo) by default; a limit leaves out what it says.
TEST(WhiteBox, LightOfAllBouncesByDefault) {
  for (const float albedo : {0.8f, 0.9f}) {
    TestScene box;
    box.add_box_seen_from_inside({0, 0, 0}, 1.0f, box.add_material(glm::vec3{albedo}, glm::vec3{1.0f}));
    const WorldCamera camera = camera_at({0.3f, -0.2f, 0.4f}, {-1.0f, 0.4f, -0.7f}, {0, 1, 0}, 1.2f);
    const PathTracerOptions by_default{.width = 24, .height = 24, .samples = 128};
    const WarningCapture capture;
    expect_mean(box.render(camera, by_default).combined, 1.0 / (1.0 - static_cast<double>(albedo)), "all bounces");
    EXPECT_TRUE(capture.warnings().empty());
    box.render(camera, test_options(24, 128, 8));
    ASSERT_EQ(capture.warnings().size(), 1u);
    const std::string share = albedo > 0.85f ? "about 35 %" : "about 11 %";  // albedo^10
    EXPECT_NE(capture.warnings()[0].find(share), std::string::npos) << capture.warnings()[0];
  }
}

TEST_P(ClosedBox, RadianceIsAGeometricSeries) {
  const auto [half, center] = GetParam();
  TestScene box;
  box.add_box_seen_from_inside(center, half, box.add_material(glm::vec3{0.5f}, glm::vec3{1.0f}));
  const WorldCamera camera = camera_at(center + half * glm::vec3{0.3f, -0.2f, 0.4f},
                                       center + half * glm::vec3{-1.0f, 0.4f, -0.7f}, {0, 1, 0}, 1.2f);
  const std::pair<int, double> cases[] = {{0, 1.5}, {1, 1.75}, {2, 1.875}, {64, 2.0}};
  for (const auto& [bounces, expected] : cases) {
    const Picture picture = box.render(camera, test_options(16, 256, bounces));
    const std::string what = std::to_string(bounces) + " bounces, half side " + std::to_string(half);
    expect_uniform(picture.emission, 1.0, 1e-5, what);
    expect_mean(picture.direct, 0.5, what);
    expect_mean(picture.combined, expected, what);
    if (bounces == 0) expect_uniform(picture.indirect, 0.0, 0.0, what);
  }
}

// No light gets in from outside: neither through the edges nor where rays start on the walls.
TEST_P(ClosedBox, IsSealed) {
  const auto [half, center] = GetParam();
  TestScene box;
  box.add_box_seen_from_inside(center, half, box.add_material(glm::vec3{0.9f}));
  box.scene.environment.radiance = glm::vec3{1.0f};
  box.snapshot.lights.push_back(
      {LightType::kDirectional, {0, 0, 0}, glm::normalize(glm::vec3{1, -2, 3}), glm::vec3{kPi}, 1, 0});
  const WorldCamera camera = camera_at(center + half * glm::vec3{0.3f, -0.2f, 0.4f}, center - half, {0, 1, 0}, 2.0f);
  // Points within a rounding error of an edge may land beyond it: their number grows with the coordinates.
  const double limit = 1e-6 + 1e-7 * static_cast<double>(glm::length(center) / half);
  EXPECT_LT(mean_of(box.render(camera, test_options(64, 64, 8)).combined).g, limit);
}

INSTANTIATE_TEST_SUITE_P(SmallToHuge, ClosedBox,
                         testing::Values(BoxPlace{1.0f, {0, 0, 0}}, BoxPlace{0.1f, {0, 0, 0}},
                                         BoxPlace{2000.0f, {0, 0, 0}}, BoxPlace{1.0f, {300, -200, 500}}));

// A point light of pi W/sr at the centre gives the unit sphere the irradiance pi, hence rho times the radiance 1;
// inside a sphere every bounce multiplies by rho again.
TEST(Sphere, PointLightAtItsCentre) {
  TestScene sphere;
  sphere.add_sphere({0, 0, 0}, 1.0f, 96, true, sphere.add_material(glm::vec3{0.5f}));
  sphere.snapshot.lights.push_back({LightType::kPoint, {0, 0, 0}, {0, 0, -1}, glm::vec3{kPi}, 1.0f, 0.0f});
  const WorldCamera camera = camera_at({0.2f, 0.1f, 0.3f}, {1, 0.2f, -0.5f}, {0, 1, 0}, 1.2f);
  const std::pair<int, double> cases[] = {{0, 0.5}, {1, 0.75}, {2, 0.875}, {64, 1.0}};
  for (const auto& [bounces, expected] : cases) {
    const Picture picture = sphere.render(camera, test_options(24, 64, bounces));
    expect_mean(picture.combined, expected, std::to_string(bounces) + " bounces");
    expect_uniform(picture.direct, 0.5, 0.01, "direct");
    expect_uniform(picture.emission, 0.0, 0.0, "emission");
  }
}

// The sun or a constant sky outside lights a convex body with E = pi L or E = S cos, whatever its shape.
TEST(ConvexBody, ConstantEnvironment) {
  for (const bool mapped : {false, true}) {
    TestScene body;
    body.add_sphere({0, 0, 0}, 1.0f, 96, false, body.add_material(glm::vec3{0.6f, 0.3f, 0.9f}));
    body.scene.environment.radiance = {1.0f, 2.0f, 0.5f};
    if (mapped) {
      body.scene.environment.map = Image(8, 4, 3);
      for (float& value : body.scene.environment.map.pixels) value = 3.0f;
    }
    const float scale = mapped ? 3.0f : 1.0f;
    const Picture picture = body.render(camera_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.1f), test_options(16, 256, 4));
    const glm::dvec3 mean = mean_of(picture.direct);
    EXPECT_NEAR(mean.r, scale * 0.6, scale * 0.6 * kTolerance);
    EXPECT_NEAR(mean.g, scale * 0.6, scale * 0.6 * kTolerance);
    EXPECT_NEAR(mean.b, scale * 0.45, scale * 0.45 * kTolerance);
    expect_uniform(picture.indirect, 0.0, 0.0, "a convex body does not light itself");
    // The camera sees the environment as emission.
    const Picture sky = body.render(camera_at({0, 0, 5}, {0, 0, 9}, {0, 1, 0}, 0.5f), test_options(8, 4, 4));
    EXPECT_NEAR(mean_of(sky.emission).g, 2.0 * scale, 1e-5 * scale);
    expect_uniform(sky.depth, 0.0, 0.0, "nothing is seen");
  }
}

// A large white plane y = 0 seen from above at a small spot around `target`.
struct LitPlane : TestScene {
  LitPlane() { add_quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, add_material(glm::vec3{1.0f})); }

  // Mean irradiance that the picture shows around `target`: E = pi L / albedo.
  double irradiance_at(const glm::vec3& target, int samples) const {
    const WorldCamera camera = camera_at(target + glm::vec3{0, 8, 0}, target, {0, 0, -1}, 0.002f);
    return static_cast<double>(kPi) * mean_of(render(camera, test_options(8, samples, 2)).combined).g;
  }
};

TEST(Plane, PointLight) {
  LitPlane plane;
  plane.snapshot.lights.push_back({LightType::kPoint, {0, 2, 0}, {0, 0, -1}, glm::vec3{10.0f}, 1.0f, 0.0f});
  for (const float x : {0.0f, 1.0f, 3.0f}) {
    const double d2 = 4.0 + static_cast<double>(x) * x;
    const double expected = 10.0 * (2.0 / std::sqrt(d2)) / d2;
    EXPECT_NEAR(plane.irradiance_at({x, 0, 0}, 4), expected, kTolerance * expected) << "x = " << x;
  }
}

TEST(Plane, SpotLightFallsOffAsTheSquareOfT) {
  LitPlane plane;
  const float cos_inner = std::cos(0.3f);
  const float cos_outer = std::cos(0.8f);
  plane.snapshot.lights.push_back({LightType::kSpot, {0, 2, 0}, {0, -1, 0}, glm::vec3{10.0f}, cos_inner, cos_outer});
  for (const float x : {0.0f, 0.4f, 1.0f, 1.6f}) {
    const double d2 = 4.0 + static_cast<double>(x) * x;
    const double cosine = 2.0 / std::sqrt(d2);
    const double t =
        std::min(1.0, (cosine - static_cast<double>(cos_outer)) / static_cast<double>(cos_inner - cos_outer));
    const double expected = 10.0 * t * t * cosine / d2;
    EXPECT_NEAR(plane.irradiance_at({x, 0, 0}, 4), expected, kTolerance * expected) << "x = " << x;
  }
  EXPECT_EQ(plane.irradiance_at({2.5f, 0, 0}, 4), 0.0) << "outside the cone";
}

TEST(Plane, Sun) {
  LitPlane plane;
  const glm::vec3 direction = glm::normalize(glm::vec3{1, -2, 0.5f});
  plane.snapshot.lights.push_back({LightType::kDirectional, {0, 0, 0}, direction, glm::vec3{7.0f}, 1.0f, 0.0f});
  const double expected = 7.0 * static_cast<double>(-direction.y);
  EXPECT_NEAR(plane.irradiance_at({0, 0, 0}, 4), expected, kTolerance * expected);
}

// Form factor of a parallel rectangle a x b at height h seen from below one of its corners (Howell 1982, B-3).
double corner_form_factor(double a, double b, double h) {
  const double x = a / h, y = b / h;
  const double sx = std::sqrt(1.0 + x * x), sy = std::sqrt(1.0 + y * y);
  return (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy)) / (2.0 * static_cast<double>(kPi));
}

TEST(Plane, QuadLight) {
  for (const bool double_sided : {false, true}) {
    LitPlane plane;
    const int light = plane.add_material(glm::vec3{0.0f}, glm::vec3{5.0f});
    plane.scene.materials.back().double_sided = double_sided;
    plane.add_quad({-1, 1.5f, -0.5f}, {2, 0, 0}, {0, 0, 1}, light);  // faces down
    const double expected = 5.0 * static_cast<double>(kPi) * 4.0 * corner_form_factor(1.0, 0.5, 1.5);
    // Seen from below the light, which would be in the way from above.
    const WorldCamera camera = camera_at({0, 1, 0}, {0, 0, 0}, {0, 0, -1}, 0.002f);
    const Picture picture = plane.render(camera, test_options(8, 256, 0));
    EXPECT_NEAR(static_cast<double>(kPi) * mean_of(picture.direct).g, expected, kTolerance * expected);
  }
}

TEST(Plane, EmissionLeavesTheFrontOnlyUnlessDoubleSided) {
  for (const bool double_sided : {false, true}) {
    LitPlane plane;
    const int light = plane.add_material(glm::vec3{0.0f}, glm::vec3{5.0f});
    plane.scene.materials.back().double_sided = double_sided;
    plane.add_quad({-1, 1.5f, -0.5f}, {0, 0, 1}, {2, 0, 0}, light);  // faces up
    const Picture below = plane.render(camera_at({0, 1, 0}, {0, 0, 0}, {0, 0, -1}, 0.002f), test_options(4, 64, 0));
    const Picture light_from_below =
        plane.render(camera_at({0, 1, 0}, {0, 2, 0}, {0, 0, -1}, 0.002f), test_options(4, 4, 0));
    EXPECT_EQ(mean_of(below.direct).g > 0.0, double_sided);
    EXPECT_EQ(mean_of(light_from_below.emission).g, double_sided ? 5.0 : 0.0);
  }
}

// Many lights: one is chosen at random for each path, and the mean is still their sum.
TEST(Plane, ManyLightsAddUp) {
  LitPlane plane;
  double expected = 0.0;
  for (int i = 0; i < 50; ++i) {
    const float x = 0.2f * static_cast<float>(i) - 5.0f;
    plane.snapshot.lights.push_back(
        {LightType::kPoint, {x, 2, 0.5f}, {0, 0, -1}, glm::vec3{1.0f + 0.1f * static_cast<float>(i)}, 1, 0});
    const double d2 = 4.25 + static_cast<double>(x) * x;
    expected += (1.0 + 0.1 * i) * 2.0 / (d2 * std::sqrt(d2));
  }
  EXPECT_NEAR(plane.irradiance_at({0, 0, 0}, 64), expected, kTolerance * expected);
}

}  // namespace
}  // namespace lightwell
