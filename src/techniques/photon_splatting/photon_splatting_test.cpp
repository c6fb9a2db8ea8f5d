// Both presets, frame by frame, on scenes whose light is known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/builtin.h"
#include "techniques/photon_splatting/best.h"
#include "techniques/photon_splatting/paper.h"
#include "techniques/technique_frames.h"

namespace lightwell {
namespace {

class PhotonSplattingTest : public DeviceTest {
 protected:
  // Fewer photons than usual.
  static PhotonSplattingBestOptions best_options() {
    PhotonSplattingBestOptions options;
    options.photons.photons = 2048;
    return options;
  }
  static PhotonSplattingPaperOptions paper_options() {
    PhotonSplattingPaperOptions options;
    options.photons.photons = 4096;
    return options;
  }
  static std::unique_ptr<Technique> best(const PhotonSplattingBestOptions& options = best_options()) {
    return std::make_unique<PhotonSplattingBest>(options);
  }
  static std::unique_ptr<Technique> paper(const PhotonSplattingPaperOptions& options = paper_options()) {
    return std::make_unique<PhotonSplattingPaper>(options);
  }
  static TechniqueFrames frames(const std::string& scene, std::unique_ptr<Technique> technique,
                                std::uint32_t side = 48) {
    return TechniqueFrames(device(), load_scene(resolve_scene(scene)), std::move(technique), side);
  }
};

// A point light of intensity pi in the middle of a unit sphere of albedo 1/2: E = pi directly, and as much again from
// all bounces, pi / 2 from the first.
TEST_F(PhotonSplattingTest, ASphereIsLitFromWithin) {
  for (const int bounces : {1, 8}) {
    PhotonSplattingBestOptions options = best_options();
    options.photons.bounces = bounces;
    TechniqueFrames sphere = frames("sphere", best(options), 32);
    TechniquePicture picture;
    for (int i = 0; i < 12; ++i) picture = sphere.next();
    const double truth = std::numbers::pi * (1.0 - std::pow(0.5, bounces));
    EXPECT_NEAR(mean_irradiance(picture) / truth, 1.0, 0.03) << bounces << " bounces";
    double squares = 0.0;
    for (const glm::vec4& e : picture.irradiance) squares += std::pow(e.x / truth - 1.0, 2.0);
    EXPECT_LE(std::sqrt(squares / static_cast<double>(picture.irradiance.size())), 0.1) << bounces << " bounces";
  }
}

TEST_F(PhotonSplattingTest, TheSameFramesGiveTheSameBytes) {
  for (const bool is_best : {true, false}) {
    const auto render = [&] {
      TechniqueFrames f = frames("cornell-spot", is_best ? best() : paper(), 40);
      TechniquePicture picture;
      for (int i = 0; i < 3; ++i) picture = f.next();
      return picture.irradiance;
    };
    EXPECT_EQ(render(), render());
  }
}

// The published preset draws the same picture in every frame, the other one its mean: steady in the end.
TEST_F(PhotonSplattingTest, PicturesBecomeSteady) {
  TechniqueFrames published = frames("cornell-spot", paper(), 32);
  const TechniquePicture first = published.next();
  EXPECT_TRUE(first.steady);
  EXPECT_EQ(first.irradiance, published.next().irradiance);
  PhotonSplattingBestOptions few = best_options();
  few.photons.photons = 256;
  TechniqueFrames f = frames("cornell-spot", best(few), 32);
  EXPECT_FALSE(f.next().steady);
  f.run_until_steady();
}

TEST_F(PhotonSplattingTest, WithoutLightItIsDark) {
  for (const bool is_best : {true, false}) {
    TechniqueFrames f = frames("cornell-spot", is_best ? best() : paper(), 24);
    f.world.lights.clear();
    for (const glm::vec4& e : f.next().irradiance) EXPECT_EQ(glm::vec3(e), glm::vec3(0.0f));
    // A lamp far outside that shines away.
    TechniqueFrames outside = frames("cornell-spot", is_best ? best() : paper(), 24);
    outside.world.lights.at(0).position = {0.0f, 100.0f, 0.0f};
    outside.world.lights.at(0).direction = {0.0f, 1.0f, 0.0f};
    for (const glm::vec4& e : outside.next().irradiance) EXPECT_EQ(glm::vec3(e), glm::vec3(0.0f));
  }
}

// Where no splat is, the published preset shows the ambient light; a blur keeps a constant.
TEST_F(PhotonSplattingTest, AmbientLightFillsGaps) {
  for (const int blur : {0, 1, 4}) {
    PhotonSplattingPaperOptions options = paper_options();
    options.ambient = 0.25f;
    options.blur = blur;
    TechniqueFrames f = frames("cornell-spot", paper(options), 24);
    f.world.lights.clear();
    const TechniquePicture picture = f.next();
    for (std::size_t i = 0; i < picture.irradiance.size(); ++i) {
      if (picture.position[i].w > 0.0f)
        EXPECT_NEAR(picture.irradiance[i].x, 0.25f, 1e-6f);
      else
        EXPECT_EQ(picture.irradiance[i].x, 0.0f);
    }
  }
}

// Divided by its weight the published light does not grow with the number of photons.
TEST_F(PhotonSplattingTest, PublishedLightIsAMean) {
  const auto mean = [&](int photons, float exposure) {
    PhotonSplattingPaperOptions options = paper_options();
    options.photons.photons = photons;
    options.photons.width = 0.3f;
    options.exposure = exposure;
    return mean_irradiance(frames("cornell-spot", paper(options), 32).next());
  };
  const double few = mean(1024, 1.0f);
  EXPECT_GT(few, 0.0);
  EXPECT_NEAR(mean(4096, 1.0f) / few, 1.0, 0.05);
  EXPECT_NEAR(mean(1024, 3.0f) / few, 3.0, 1e-4);
}

TEST_F(PhotonSplattingTest, StratifiedPhotonsLightTheSceneToo) {
  for (const bool is_best : {true, false}) {
    PhotonSplattingBestOptions b = best_options();
    PhotonSplattingPaperOptions p = paper_options();
    b.photons.stratify = p.photons.stratify = 2;
    const double all = mean_irradiance(frames("cornell-spot", is_best ? best() : paper(), 32).next());
    const double stratified = mean_irradiance(frames("cornell-spot", is_best ? best(b) : paper(p), 32).next());
    EXPECT_NEAR(stratified / all, 1.0, is_best ? 0.15 : 0.5);
  }
}

}  // namespace
}  // namespace lightwell
