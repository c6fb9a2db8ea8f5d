// The photon mapper against the path tracer in built-in scenes: energy, and how fast it converges.
#include <cmath>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>
#include <glm/ext/vector_double2.hpp>

#include "lightwell/metrics.h"
#include "lightwell/path_tracer.h"
#include "lightwell/photon_mapper.h"
#include "reference/camera_rays.h"
#include "reference/test_scenes.h"

namespace lightwell {
namespace {

constexpr int kBounces = 8;

struct BuiltInScene {
  explicit BuiltInScene(const std::string& name)
      : scene(load_scene(std::string(LIGHTWELL_SOURCE_DIR) + "/scenes/" + name + ".gltf")),
        snapshot(take_snapshot(scene)) {}

  Picture trace(int side, int samples, int seed) const {
    PathTracerOptions options = test_options(side, samples, kBounces);
    options.seed = seed;
    return PathTracer(scene, snapshot).render(snapshot.cameras.at(0), options);
  }

  PhotonMapping map(int side, int photons, int k, int iterations) const {
    PhotonMapperOptions options;
    options.width = options.height = side;
    options.photons = photons;
    options.k = k;
    options.progressive = iterations;
    options.max_bounces = kBounces;
    options.samples = 2;
    return PhotonMapper(scene, snapshot).render(snapshot.cameras.at(0), options);
  }

  Scene scene;
  SceneSnapshot snapshot;
};

// Pixels all of whose neighbours up to `reach` pixels show the same plane.
Image away_from_edges(const Picture& picture, const WorldCamera& camera, int reach) {
  const RayGenerator rays(camera, picture.depth.width, picture.depth.height);
  const auto normal = [&](int x, int y) {
    const float* n = picture.normal.at(x, y);
    return glm::vec3{n[0], n[1], n[2]};
  };
  const auto position = [&](int x, int y) {
    return camera.position + *picture.depth.at(x, y) * rays.ray(glm::vec2(x, y) + 0.5f).direction;
  };
  Image mask(picture.depth.width, picture.depth.height, 1);
  for (int y = reach; y < mask.height - reach; ++y) {
    for (int x = reach; x < mask.width - reach; ++x) {
      bool same = glm::length(normal(x, y)) > 0.99f;
      for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
          const glm::vec3 offset = position(x + i, y + j) - position(x, y);
          same = same && glm::dot(normal(x, y), normal(x + i, y + j)) > 0.99f &&
                 std::abs(glm::dot(offset, normal(x, y))) < 0.01f;
        }
      }
      *mask.at(x, y) = same ? 1.0f : 0.0f;
    }
  }
  return mask;
}

class PhotonMapperInScene : public testing::TestWithParam<std::string> {};

TEST_P(PhotonMapperInScene, AMillionPhotonsHaveTheEnergyOfThePathTracerAwayFromEdges) {
  const BuiltInScene built_in(GetParam());
  constexpr int kSide = 64;
  const Picture truth = built_in.trace(kSide, 256, 3);
  const PhotonMapping mapping = built_in.map(kSide, 1'000'000, 100, 1);
  const Image mask = away_from_edges(truth, built_in.snapshot.cameras.at(0), 2);
  MetricOptions options;
  options.mask = &mask;
  const Metrics metrics = compute_metrics(mapping.picture.indirect, truth.indirect, options);
  std::cout << GetParam() << ": " << mapping.statistics.stored << " photons, energy of indirect light "
            << metrics.energy << " at " << metrics.pixels << " pixels, relMSE " << metrics.rel_mse << "\n";
  EXPECT_GT(metrics.pixels, kSide * kSide / 4);
  EXPECT_NEAR(metrics.energy, 1.0, 0.02);
  for (const double energy : metrics.energy_rgb) EXPECT_NEAR(energy, 1.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Cornell, PhotonMapperInScene, testing::Values("cornell-spot", "cornell-box"),
                         [](const auto& test) { return std::string(test.param == "cornell-box" ? "box" : "spot"); });

// Slope of the line through points of least squares.
double slope(const std::vector<glm::dvec2>& points) {
  glm::dvec2 mean{0.0};
  for (const glm::dvec2& point : points) mean += point / static_cast<double>(points.size());
  double xx = 0.0, xy = 0.0;
  for (const glm::dvec2& point : points) {
    xx += (point.x - mean.x) * (point.x - mean.x);
    xy += (point.x - mean.x) * (point.y - mean.y);
  }
  return xy / xx;
}

// In theory relMSE falls with the number of iterations to the power -2/3 (Knaus and Zwicker 2011). Half of what two
// pictures of the path tracer differ by is the noise of one of them.
TEST(PhotonMapperProgressive, ErrorFallsWithPhotons) {
  const BuiltInScene cornell("cornell-spot");
  constexpr int kSide = 32;
  constexpr int kPhotons = 20000;
  const Image truth = cornell.trace(kSide, 1024, 11).indirect;
  const double noise = 0.5 * compute_metrics(cornell.trace(kSide, 1024, 12).indirect, truth).rel_mse;
  std::vector<glm::dvec2> points;
  for (const int iterations : {2, 4, 8, 16, 32}) {
    const Metrics metrics = compute_metrics(cornell.map(kSide, kPhotons, 20, iterations).picture.indirect, truth);
    const double error = metrics.rel_mse - noise;
    std::cout << iterations << " x " << kPhotons << " photons: relMSE " << error << " beside noise of " << noise
              << ", energy " << metrics.energy << "\n";
    ASSERT_GT(error, 0.0);
    points.emplace_back(std::log(iterations), std::log(error));
    EXPECT_NEAR(metrics.energy, 1.0, 0.02);
  }
  std::cout << "slope " << slope(points) << "\n";
  EXPECT_LE(slope(points), -0.55);
}

}  // namespace
}  // namespace lightwell
