// Photons that start where views see them: right in the mean, less noise where views see little of the scene.
#include "techniques/photon_splatting/photon_guide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <string>

#include "passes/light_paths/light_path_guide.h"
#include "scene/builtin.h"
#include "techniques/photon_splatting/best.h"
#include "techniques/photon_splatting/photon_test_frames.h"
#include "techniques/technique_frames.h"

namespace lightwell {
namespace {

class PhotonGuideTest : public DeviceTest {
 protected:
  // Each frame by itself; kernels of one width, part of the scene's diagonal, for they would shrink where photons are
  // denser.
  static TechniqueFrames frames(const Scene& scene, bool guide, int photons, int bounces, float width) {
    PhotonSplattingBestOptions options{.history = 0, .filter = false};
    options.photons.photons = photons;
    options.photons.bounces = bounces;
    options.photons.guide = guide;
    options.photons.least_width = options.photons.most_width = width;
    return TechniqueFrames(device(), scene, std::make_unique<PhotonSplattingBest>(options), 40);
  }

  static Scene box() { return make_box({1, 1.5f, 2}, make_material({0.5f, 0.25f, 0.75f})); }
};

std::vector<glm::dvec3> mean_of(TechniqueFrames& frames, int count) {
  std::vector<glm::dvec3> mean;
  for (int i = 0; i < count; ++i) {
    const TechniquePicture picture = frames.next();
    mean.resize(picture.irradiance.size(), glm::dvec3(0.0));
    for (std::size_t p = 0; p < mean.size(); ++p) mean[p] += glm::dvec3(picture.irradiance[p]) / double(count);
  }
  return mean;
}

double mean_of(const std::vector<glm::dvec3>& picture) {
  double sum = 0.0;
  for (const glm::dvec3& e : picture) sum += (e.x + e.y + e.z) / 3.0;
  return sum / static_cast<double>(picture.size());
}

// Of single frames, over the mean.
double relative_rmse(TechniqueFrames& frames, const std::vector<glm::dvec3>& truth, int count) {
  double squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const TechniquePicture picture = frames.next();
    for (std::size_t p = 0; p < truth.size(); ++p)
      squares += std::pow(double{picture.irradiance[p].y} - truth[p].y, 2.0);
  }
  return std::sqrt(squares / static_cast<double>(count) / static_cast<double>(truth.size())) / mean_of(truth);
}

// A lamp behind a wall sends five sixths of the light to where nobody looks.
TEST_F(PhotonGuideTest, ALampBehindAWallTakesFewPhotons) {
  const Scene scene = load_scene(resolve_scene("two-rooms"));
  TechniqueFrames many = frames(scene, false, 16384, 3, 0.05f);
  TechniqueFrames guided = frames(scene, true, 1024, 3, 0.05f);
  TechniqueFrames unguided = frames(scene, false, 1024, 3, 0.05f);
  for (TechniqueFrames* f : {&many, &guided, &unguided})
    f->world.lights.push_back(make_point_light({1.6f, 2.6f, 0.4f}, {30, 30, 30}));
  const std::vector<glm::dvec3> truth = mean_of(many, 8);
  for (int i = 0; i < 8; ++i) guided.next();
  const double with = relative_rmse(guided, truth, 12);
  const double without = relative_rmse(unguided, truth, 12);
  const double energy = mean_of(mean_of(guided, 32)) / mean_of(truth);
  std::cout << "a lamp behind a wall: relative RMSE " << without << ", guided " << with << ", energy " << energy
            << "\n";
  EXPECT_LT(with, 0.65 * without);
  EXPECT_NEAR(energy, 1.0, 0.02);
}

// The sun shines on a wide floor, and into the small room where the camera is.
TEST_F(PhotonGuideTest, TheSunOnAWideFloorLightsASmallRoom) {
  Scene scene;
  const float side = 15.0f;
  add_quad(scene, {-side, 0, side}, {2 * side, 0, 0}, {0, 0, -2 * side}, make_material({0.5f, 0.5f, 0.5f}));
  add_quad(scene, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, make_material({0.5f, 0.5f, 0.5f}));   // ceiling
  add_quad(scene, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, make_material({0.5f, 0.5f, 0.5f}));   // back
  add_quad(scene, {-1, 0, 1}, {0, 0, -2}, {0, 2, 0}, make_material({0.5f, 0.25f, 0.2f}));  // sides
  add_quad(scene, {1, 0, -1}, {0, 0, 2}, {0, 2, 0}, make_material({0.2f, 0.25f, 0.5f}));
  TechniqueFrames many = frames(scene, false, 131072, 2, 0.005f);
  TechniqueFrames guided = frames(scene, true, 4096, 2, 0.005f);
  TechniqueFrames unguided = frames(scene, false, 4096, 2, 0.005f);
  for (TechniqueFrames* f : {&many, &guided, &unguided}) {
    f->world.lights = {make_sun({0.1f, -1, -0.8f}, {1, 1, 1})};
    f->camera.position = {0, 1, 0.9f};
    f->camera.forward = {0, 0, -1};
    f->camera.up = {0, 1, 0};
    f->camera.yfov = 1.5f;
  }
  const std::vector<glm::dvec3> truth = mean_of(many, 8);
  for (int i = 0; i < 12; ++i) guided.next();
  const double with = relative_rmse(guided, truth, 12);
  const double without = relative_rmse(unguided, truth, 12);
  const double energy = mean_of(mean_of(guided, 32)) / mean_of(truth);
  std::cout << "a small room: relative RMSE " << without << ", guided " << with << ", energy " << energy << "\n";
  EXPECT_LT(with, 0.65 * without);
  EXPECT_NEAR(energy, 1.0, 0.12);  // a few bright photons
}

// Strata are chosen by their density, and what the paths bring adds up to the same.
TEST_F(PhotonGuideTest, PathsStartByTheGuidesDensity) {
  const std::uint32_t seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  constexpr std::uint32_t kSide = glsl::kGuideSide;
  struct Case {
    std::vector<WorldLight> lights;
    bool sky;
  };
  for (const Case& c : {Case{{make_point_light({0.1f, 0.2f, 0.3f}, {1, 2, 3})}, false},
                        Case{{make_sun({0.1f, -1, 0.2f}, {1, 1, 1}), make_point_light({0, 1, 0}, {2, 2, 2}),
                              make_spot_light({0, 1, 0.5f}, {0, -1, 0}, 20, 40, {5, 5, 5})},
                             false},
                        Case{{}, true}}) {
    Scene scene = box();
    if (c.sky) {
      scene = Scene{};
      add_quad(scene, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, make_material({0.5f, 0.5f, 0.5f}));
      scene.environment.radiance = {1, 1, 1};
    }
    LightPathFrames frames(device(), scene, c.lights, {.paths = 65536, .bounces = 2, .rsm_lights = 0});
    const std::size_t sources = c.lights.size() + 2;
    std::vector<float> importance(sources * glsl::kGuideStrata), table;
    for (float& f : importance) f = uniform(random) < 0.3f ? 0.0f : uniform(random);
    for (std::size_t s = 0; s < sources; ++s) {
      const float* of_source = &importance[s * glsl::kGuideStrata];
      float rows = 0.0f;
      for (std::uint32_t i = 0; i < glsl::kGuideStrata; ++i) {
        rows += of_source[i];
        if (i % kSide == kSide - 1) table.push_back(rows);
      }
      float row = 0.0f;
      for (std::uint32_t i = 0; i < glsl::kGuideStrata; ++i) {
        row = i % kSide == 0 ? of_source[i] : row + of_source[i];
        table.push_back(row);
      }
    }
    const LightPoints unguided = frames.next();
    const LightPathFrames::Guided guided = frames.next_guided(table);

    std::vector<std::uint32_t> starts(sources * glsl::kGuideStrata);
    for (const std::uint32_t stratum : guided.strata) ++starts.at(stratum);
    for (std::size_t i = 0; i < starts.size(); ++i) ASSERT_EQ(guided.counts[i].x, starts[i]);
    // Within each source: its paths over strata, by importance.
    double chi_squared = 0.0, freedom = 0.0;
    for (std::size_t s = 0; s < sources; ++s) {
      const std::size_t begin = s * glsl::kGuideStrata;
      double paths = 0.0, own = 0.0;
      for (std::size_t i = begin; i < begin + glsl::kGuideStrata; ++i) {
        paths += starts[i];
        own += double{importance[i]};
      }
      if (paths < 1000.0) continue;
      // The mean over the sources' power: of one source its own; of several, found from the strata of no importance.
      double mean = own / glsl::kGuideStrata;
      if (sources > 3) {
        double unimportant = 0.0, count = 0.0;
        for (std::size_t i = begin; i < begin + glsl::kGuideStrata; ++i)
          if (importance[i] == 0.0f) unimportant += starts[i], count += 1.0;
        const double base = unimportant / count * glsl::kGuideStrata;  // paths if all strata were such
        mean = 0.8 * own / glsl::kGuideStrata / (0.2 * (paths / base - 1.0));
      }
      const double all = 0.8 * own / mean + 0.2 * glsl::kGuideStrata;
      for (std::size_t i = begin; i < begin + glsl::kGuideStrata; ++i) {
        const double expected = paths * (0.8 * double{importance[i]} / mean + 0.2) / all;
        chi_squared += std::pow(starts[i] - expected, 2.0) / expected;
        freedom += 1.0;
      }
    }
    // The sequence is spread more evenly than random numbers.
    std::cout << "chi-squared " << chi_squared << " of " << freedom << " strata\n";
    EXPECT_GT(freedom, 0.0);
    EXPECT_LT(chi_squared, freedom + 4.0 * std::sqrt(2.0 * freedom));
    for (std::size_t bounce = 0; bounce < 2; ++bounce) {
      const glm::dvec3 with = sum_flux(guided.points, bounce * 65536, (bounce + 1) * 65536);
      const glm::dvec3 without = sum_flux(unguided, bounce * 65536, (bounce + 1) * 65536);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(with[i], without[i], 0.02 * without[i]);
    }
  }
}

// Nobody has looked yet: paths start as ever.
TEST_F(PhotonGuideTest, WithoutViewsThereIsNoGuide) {
  const std::vector<WorldLight> lamp{make_point_light({0.1f, 0.2f, 0.3f}, {1, 2, 3})};
  PhotonFrames guided(device(), box(), lamp, {.photons = 4096, .bounces = 2, .guide = true});
  PhotonFrames unguided(device(), box(), lamp, {.photons = 4096, .bounces = 2});
  const PhotonFrame with = guided.next();
  const PhotonFrame without = unguided.next();
  ASSERT_EQ(with.splats.size(), without.splats.size());
  for (std::size_t i = 0; i < with.splats.size(); i += 7)
    ASSERT_LT(glm::distance(with.splats[i].center, without.splats[i].center), 1e-2f);
}

}  // namespace
}  // namespace lightwell
