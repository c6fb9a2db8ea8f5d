// The photon mapper against closed forms and the path tracer, and what else it promises.
#include "lightwell/photon_mapper.h"

#include <cmath>
#include <cstring>
#include <iostream>
#include <tuple>

#include <gtest/gtest.h>

#include "lightwell/error.h"
#include "lightwell/metrics.h"
#include "reference/test_scenes.h"

namespace lightwell {
namespace {

PhotonMapperOptions mapper_options(int side, int photons, int k, int max_bounces) {
  PhotonMapperOptions options;
  options.width = options.height = side;
  options.photons = photons;
  options.k = k;
  options.samples = 4;
  options.max_bounces = max_bounces;
  return options;
}

Picture render(const TestScene& scene, const WorldCamera& camera, const PhotonMapperOptions& options) {
  return PhotonMapper(scene.scene, scene.snapshot).render(camera, options).picture;
}

bool same_bytes(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

void expect_mean(const Image& image, const glm::dvec3& expected, double tolerance, const std::string& what) {
  const glm::dvec3 mean = mean_of(image);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], expected[c], tolerance * expected[c]) << what << ", channel " << c;
}

// A point light of pi W/sr at the centre of a unit sphere of albedo rho: irradiance pi rho^k after k bounces, hence
// radiance rho^(k + 1).
TEST(PhotonMapper, SphereWithALightInside) {
  TestScene sphere;
  sphere.add_sphere({0, 0, 0}, 1.0f, 96, true, sphere.add_material({0.5f, 0.25f, 0.75f}));
  sphere.snapshot.lights.push_back({LightType::kPoint, {0, 0, 0}, {0, 0, -1}, glm::vec3{kPi}, 1.0f, 0.0f});
  const WorldCamera camera = camera_at({0.2f, 0.1f, 0.3f}, {1, 0.2f, -0.5f}, {0, 1, 0}, 1.2f);
  const glm::dvec3 rho{0.5, 0.25, 0.75};
  const std::pair<int, glm::dvec3> cases[] = {
      {0, glm::dvec3{0.0}}, {1, rho * rho}, {2, rho * rho * (1.0 + rho)}, {64, rho * rho / (1.0 - rho)}};
  for (const auto& [bounces, expected] : cases) {
    for (const int iterations : {1, 2}) {
      PhotonMapperOptions options = mapper_options(24, 200000, 50, bounces);
      options.progressive = iterations;
      const Picture picture = render(sphere, camera, options);
      const std::string what = std::to_string(bounces) + " bounces, " + std::to_string(iterations) + " iterations";
      expect_mean(picture.indirect, expected, 0.03, what);
      expect_mean(picture.direct, rho, 0.01, what);
    }
  }
}

// Albedo rho and emission 1 everywhere: what bounced k times is rho^(k + 1). Edges are right once rays measure discs.
TEST(PhotonMapper, Furnace) {
  TestScene box;
  box.add_box_seen_from_inside({1, 2, 3}, 1.0f, box.add_material(glm::vec3{0.5f}, glm::vec3{1.0f}));
  const WorldCamera camera = camera_at({1.3f, 1.8f, 3.4f}, {0.0f, 2.4f, 2.3f}, {0, 1, 0}, 1.2f);
  for (const auto& [bounces, expected] : {std::pair{1, 0.25}, std::pair{64, 0.5}}) {
    PhotonMapperOptions options = mapper_options(24, 100000, 50, bounces);
    const double dark_edges = mean_of(render(box, camera, options).indirect).g;
    options.progressive = 4;
    const double progressive = mean_of(render(box, camera, options).indirect).g;
    std::cout << bounces << " bounces: " << dark_edges / expected << " of the truth, progressive "
              << progressive / expected << "\n";
    EXPECT_NEAR(dark_edges, expected, 0.05 * expected);
    EXPECT_LT(dark_edges, progressive);
    EXPECT_NEAR(progressive, expected, 0.01 * expected);
  }
}

// A room with every kind of light in it, curved and flat.
TestScene make_busy_scene() {
  TestScene busy;
  busy.add_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, busy.add_material({0.8f, 0.7f, 0.6f}));
  busy.add_quad({-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, busy.add_material({0.6f, 0.7f, 0.8f}));
  busy.add_quad({-2, 0, -2}, {0, 3, 0}, {0, 0, 4}, busy.add_material({0.9f, 0.5f, 0.5f}));
  busy.add_sphere({0, 0.8f, 0}, 0.8f, 24, false, busy.add_material({0.2f, 0.7f, 0.4f}));
  busy.add_quad({1, 2.5f, -0.5f}, {0, 0, 1}, {-1, 0, 0}, busy.add_material(glm::vec3{0.0f}, {6, 5, 4}));
  busy.snapshot.lights.push_back({LightType::kPoint, {-1, 2, 1}, {0, 0, -1}, {3, 2, 1}, 1.0f, 0.0f});
  busy.snapshot.lights.push_back(
      {LightType::kSpot, {1.5f, 2, 1.5f}, glm::normalize(glm::vec3{-2, -2, -3}), {9, 8, 7}, 0.95f, 0.8f});
  busy.snapshot.lights.push_back(
      {LightType::kDirectional, {0, 0, 0}, glm::normalize(glm::vec3{-1, -1, -1}), {1, 1, 2}, 1.0f, 0.0f});
  busy.scene.environment.radiance = {0.3f, 0.4f, 0.5f};
  busy.scene.environment.map = Image(4, 2, 3);
  for (std::size_t i = 0; i < busy.scene.environment.map.pixels.size(); ++i) {
    busy.scene.environment.map.pixels[i] = static_cast<float>(i % 5);
  }
  return busy;
}

const WorldCamera kBusyCamera = camera_at({2.5f, 2, 4}, {-0.3f, 0.8f, -0.5f}, {0, 1, 0}, 0.7f);

TEST(PhotonMapper, HasTheEnergyOfThePathTracerUnderEveryLight) {
  const TestScene busy = make_busy_scene();
  const Picture truth = busy.render(kBusyCamera, test_options(32, 256, 8));
  PhotonMapperOptions options = mapper_options(32, 200000, 30, 8);
  options.progressive = 4;
  const Picture picture = render(busy, kBusyCamera, options);
  for (const auto& [name, image, reference] : {std::tuple{"direct", &picture.direct, &truth.direct},
                                               std::tuple{"indirect", &picture.indirect, &truth.indirect},
                                               std::tuple{"emission", &picture.emission, &truth.emission}}) {
    const Metrics metrics = compute_metrics(*image, *reference);
    std::cout << name << ": energy " << metrics.energy << ", relMSE " << metrics.rel_mse << "\n";
    EXPECT_NEAR(metrics.energy, 1.0, 0.02) << name;
    for (const double energy : metrics.energy_rgb) EXPECT_NEAR(energy, 1.0, 0.03) << name;
  }
}

TEST(PhotonMapper, SameBytesWhateverTheNumberOfThreads) {
  const TestScene busy = make_busy_scene();
  PhotonMapperOptions options = mapper_options(40, 20000, 20, 6);
  options.height = 37;
  for (const int iterations : {1, 3}) {
    options.progressive = iterations;
    options.seed = 1;
    options.threads = 1;
    const Picture one = render(busy, kBusyCamera, options);
    options.threads = 2;
    const Picture two = render(busy, kBusyCamera, options);
    EXPECT_TRUE(same_bytes(one.combined, two.combined));
    EXPECT_TRUE(same_bytes(one.indirect, two.indirect));
    EXPECT_TRUE(same_bytes(one.depth, two.depth));
    options.seed = 2;
    EXPECT_FALSE(same_bytes(one.indirect, render(busy, kBusyCamera, options).indirect));
  }
}

TEST(PhotonMapper, DirectLightIsThePathTracers) {
  const TestScene busy = make_busy_scene();
  const Picture traced = busy.render(kBusyCamera, test_options(16, 4, 0));
  const Picture mapped = render(busy, kBusyCamera, mapper_options(16, 1000, 10, 3));
  EXPECT_TRUE(same_bytes(traced.direct, mapped.direct));
  EXPECT_TRUE(same_bytes(traced.emission, mapped.emission));
  EXPECT_TRUE(same_bytes(traced.albedo, mapped.albedo));
  EXPECT_TRUE(same_bytes(traced.normal, mapped.normal));
  for (std::size_t i = 0; i < mapped.combined.pixels.size(); ++i) {
    const float sum = mapped.direct.pixels[i] + mapped.indirect.pixels[i] + mapped.emission.pixels[i];
    EXPECT_NEAR(mapped.combined.pixels[i], sum, 1e-5f * (1.0f + sum));
  }
}

// What sends no photons, or none that meet anything, leaves a picture of direct light.
TEST(PhotonMapper, WithoutPhotonsIndirectLightIsBlack) {
  const TestScene busy = make_busy_scene();
  const Picture none = render(busy, kBusyCamera, mapper_options(8, 0, 10, 3));
  EXPECT_EQ(mean_of(none.indirect), glm::dvec3(0.0));
  EXPECT_GT(mean_of(none.direct).g, 0.0);

  const Picture empty = render(TestScene{}, WorldCamera{}, mapper_options(8, 1000, 10, 3));
  EXPECT_EQ(mean_of(empty.combined), glm::dvec3(0.0));

  TestScene unlit;
  unlit.add_box_seen_from_inside({0, 0, 0}, 1.0f, unlit.add_material(glm::vec3{0.5f}));
  EXPECT_EQ(
      mean_of(render(unlit, camera_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1), mapper_options(8, 1000, 10, 3)).combined),
      glm::dvec3(0.0));
}

// A sealed box, its lights outside.
TEST(PhotonMapper, LightOutsideStaysOutside) {
  for (const int iterations : {1, 3}) {
    TestScene box;
    box.add_box_seen_from_inside({0, 0, 0}, 1.0f, box.add_material(glm::vec3{0.9f}));
    box.scene.environment.radiance = glm::vec3{1.0f};
    box.snapshot.lights.push_back({LightType::kPoint, {1.5f, 0, 0}, {0, 0, -1}, glm::vec3{9.0f}, 1.0f, 0.0f});
    box.snapshot.lights.push_back({LightType::kPoint, {900, 0, 0}, {0, 0, -1}, glm::vec3{9.0f}, 1.0f, 0.0f});
    box.snapshot.lights.push_back(
        {LightType::kDirectional, {0, 0, 0}, glm::normalize(glm::vec3{1, -2, 3}), glm::vec3{kPi}, 1, 0});
    PhotonMapperOptions options = mapper_options(16, 100000, 20, 4);
    options.progressive = iterations;
    const Picture picture = render(box, camera_at({0.3f, 0, 0}, {-1, -1, -1}, {0, 1, 0}, 2.0f), options);
    EXPECT_EQ(mean_of(picture.indirect), glm::dvec3(0.0));
  }
}

TEST(PhotonMapper, CountsWhatItDid) {
  const TestScene busy = make_busy_scene();
  PhotonMapperOptions options = mapper_options(20, 10000, 20, 4);
  options.progressive = 3;
  const PhotonMapperStatistics statistics =
      PhotonMapper(busy.scene, busy.snapshot).render(kBusyCamera, options).statistics;
  EXPECT_EQ(statistics.emitted, 30000);
  EXPECT_GT(statistics.stored, 0);
  EXPECT_LE(statistics.photons_kept, statistics.stored);
  EXPECT_GE(3 * statistics.photons_kept, statistics.stored);
  EXPECT_EQ(statistics.photon_bytes, 36u * static_cast<std::uint64_t>(statistics.photons_kept));
  EXPECT_LT(statistics.tree_bytes, 64u * static_cast<std::uint64_t>(statistics.photons_kept));
  EXPECT_GT(statistics.queries, 0);
  EXPECT_LE(statistics.queries, 20 * 20 * 4 * 3);
  EXPECT_GT(statistics.us_per_query, 0.0);
  EXPECT_GT(statistics.photons_per_query, 2.0);
  EXPECT_LE(statistics.photons_per_query, 25.0);
  EXPECT_GE(statistics.threads, 1);
  EXPECT_LE(statistics.emission_ms + statistics.tree_ms, statistics.wall_time_ms);
}

TEST(PhotonMapper, ProgressRisesToOneAndMayEndTheRendering) {
  const TestScene busy = make_busy_scene();
  const PhotonMapper mapper(busy.scene, busy.snapshot);
  PhotonMapperOptions options = mapper_options(40, 10000, 10, 2);
  options.progressive = 2;
  float last = 0.0f;
  mapper.render(kBusyCamera, options, [&](float done) {
    EXPECT_GT(done, last);
    last = done;
  });
  EXPECT_EQ(last, 1.0f);
  EXPECT_THROW(mapper.render(kBusyCamera, options, [](float) { throw InputError("test", "enough"); }), InputError);
}

TEST(PhotonMapper, OptionsOutOfRangeAreNamed) {
  const TestScene empty;
  for (const auto& [member, value, name] :
       {std::tuple{&PhotonMapperOptions::width, 0, "width"}, std::tuple{&PhotonMapperOptions::height, 100000, "height"},
        std::tuple{&PhotonMapperOptions::photons, -1, "photons"}, std::tuple{&PhotonMapperOptions::k, 1, "k "},
        std::tuple{&PhotonMapperOptions::progressive, 0, "progressive"},
        std::tuple{&PhotonMapperOptions::samples, 0, "samples"},
        std::tuple{&PhotonMapperOptions::max_bounces, -1, "max-bounces"}}) {
    PhotonMapperOptions options;
    options.*member = value;
    try {
      render(empty, WorldCamera{}, options);
      FAIL() << name;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace lightwell
