// Preset `best` against pictures of another renderer, and against the presets `paper` and `paper-lpv` in the same
// run. The references are not part of the project: without them these tests are skipped.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "lightwell/image.h"
#include "lightwell/metrics.h"
#include "techniques/light_volume/best_test_frames.h"
#include "techniques/light_volume/paper_solver.h"

namespace lightwell {
namespace {

constexpr int kSide = 256;

struct Compared {
  Metrics indirect;
  Metrics combined;
};

class LightVolumeBestReferenceTest : public DeviceTest {
 protected:
  // Loads a scene and its pictures; false, and the test skipped, where they are not there.
  bool load(const std::string& name, float exposure) {
    const std::string folder = LIGHTWELL_SHARED_DIR "/references/" + name + "/";
    if (!std::filesystem::exists(folder)) return false;
    scene_ = load_scene(folder + name + ".glb");
    reference_indirect_ = load_image(folder + "cam0_indirect.exr");
    reference_combined_ = load_image(folder + "cam0_combined.exr");
    exposure_ = exposure;
    return true;
  }

  // Over the pixels where `counts(position, normal)`.
  template <class Counts>
  Compared compare(const TechniquePicture& picture, const Counts& counts) const {
    Image indirect(kSide, kSide);
    Image combined(kSide, kSide);
    Image mask(kSide, kSide, 1);
    for (std::size_t i = 0; i < picture.irradiance.size(); ++i) {
      const glm::vec3 position(picture.position[i]);
      const bool is_surface = picture.position[i].w > 0.0f;
      mask.pixels[i] = is_surface && counts(position, glm::vec3(picture.normal[i])) ? 1.0f : 0.0f;
      for (int c = 0; c < 3; ++c) {
        const float reflects = is_surface ? picture.albedo[i][c] / std::numbers::pi_v<float> : 0.0f;
        const std::size_t at = 3 * i + static_cast<std::size_t>(c);
        indirect.pixels[at] = reflects * picture.irradiance[i][c];
        combined.pixels[at] = reflects * (picture.irradiance[i][c] + picture.direct[i][c]);
      }
    }
    MetricOptions options;
    options.exposure = exposure_;
    options.mask = &mask;
    return {compute_metrics(indirect, reference_indirect_, options),
            compute_metrics(combined, reference_combined_, options)};
  }
  Compared compare(const TechniquePicture& picture) const {
    return compare(picture, [](glm::vec3, glm::vec3) { return true; });
  }

  TechniquePicture render(const LightCacheOptions& options) {
    BestFrames frames(device(), scene_, options, kSide);
    TechniquePicture picture;
    for (int frame = 0; frame < 20; ++frame) picture = frames.next();
    return picture;
  }

  static void expect_energy(const char* where, double energy) {
    std::printf("  %-10s energy %.3f\n", where, energy);
    EXPECT_GT(energy, 0.85) << where;
    EXPECT_LT(energy, 1.15) << where;
  }

  // Time of moving light: what voxelises and what pixels look up aside, on both sides.
  static double transport_time(const TechniquePicture& picture) {
    double sum = 0.0;
    for (const auto& [name, time] : picture.times_ms) {
      const bool moves_light = name.starts_with("light cache:") || name == "propagate";
      if (moves_light && name != "light cache: look-up") sum += time;
    }
    return sum;
  }

  // At no more error than `paper` after 64 steps, at most half its time.
  void expect_faster_than_paper() {
    TechniqueFrames paper(device(), scene_, std::make_unique<LightVolumePaper>(PaperVariant::kMavridis), kSide);
    BestFrames best(device(), scene_, best_options(32, 64, 2), kSide);
    // Pipelines are made in the first frames; after that the least ratio of eight pairs, since other programs run too.
    TechniquePicture paper_picture = paper.next();
    TechniquePicture best_picture = best.next();
    double part = 1e30;
    for (int run = 0; run < 8; ++run) {
      best.restart = true;
      paper_picture = paper.next();
      best_picture = best.next();
      part = std::min(part, transport_time(best_picture) / transport_time(paper_picture));
    }
    const double paper_error = compare(paper_picture).indirect.rel_mse;
    const double best_error = compare(best_picture).indirect.rel_mse;
    std::printf("  paper: relMSE %.4f; best, one frame from nothing, in %.2f of its time: relMSE %.4f\n", paper_error,
                part, best_error);
    EXPECT_LE(best_error, paper_error);
    EXPECT_LE(part, 0.5);
  }

  Scene scene_;
  Image reference_indirect_;
  Image reference_combined_;
  float exposure_ = 1.0f;
};

const LightCacheOptions kCoarse = best_options(32, 64, 8);
const LightCacheOptions kFine = best_options(64, 64, 8);

TEST_F(LightVolumeBestReferenceTest, CornellBoxWithASpot) {
  if (!load("cornell_spot", 2.0f)) GTEST_SKIP() << "no reference pictures";
  const TechniquePicture picture = render(kCoarse);
  const Compared whole = compare(picture);
  expect_energy("whole", whole.indirect.energy);
  expect_energy("ceiling", compare(picture, [](glm::vec3, glm::vec3 n) { return n.y < -0.9f; }).indirect.energy);
  expect_energy("back wall",
                compare(picture, [](glm::vec3 p, glm::vec3 n) { return n.z < -0.9f && p.z > 0.5f; }).indirect.energy);
  const Compared fine = compare(render(kFine));
  std::printf("  SSIM %.3f; relMSE of indirect at 32^3 %.5f, at 64^3 %.5f\n", whole.combined.ssim,
              whole.indirect.rel_mse, fine.indirect.rel_mse);
  EXPECT_GE(whole.combined.ssim, 0.85);
  EXPECT_LT(fine.indirect.rel_mse, whole.indirect.rel_mse);
}

TEST_F(LightVolumeBestReferenceTest, RoomWithWindows) {
  if (!load("room_windows", 1.0f)) GTEST_SKIP() << "no reference pictures";
  // What the camera sees below the flight of stairs, which climbs from (z 5, y 0) to (z 1.4, y 3) along x 6.4 to 8.
  const auto under_stairs = [](glm::vec3 p, glm::vec3 n) {
    return p.x > 6.4f && p.z > 0.1f && p.z < 5.0f && p.y < 3.0f * (5.0f - p.z) / 3.6f - 0.2f && p.y < 2.8f &&
           (n.y > 0.9f ? p.y < 0.1f : n.x < -0.9f && p.x > 7.9f);
  };
  const TechniquePicture picture = render(kCoarse);
  const Compared whole = compare(picture);
  expect_energy("whole", whole.indirect.energy);
  expect_energy("ceiling",
                compare(picture, [](glm::vec3 p, glm::vec3 n) { return n.y < -0.9f && p.y > 4.9f; }).indirect.energy);
  expect_energy("back wall",
                compare(picture, [](glm::vec3 p, glm::vec3 n) { return n.x < -0.9f && p.x > 7.9f; }).indirect.energy);
  const Compared fine = compare(render(kFine));
  std::printf("  SSIM %.3f; relMSE of indirect at 32^3 %.5f, at 64^3 %.5f\n", whole.combined.ssim,
              whole.indirect.rel_mse, fine.indirect.rel_mse);
  EXPECT_GE(whole.combined.ssim, 0.85);
  EXPECT_LT(fine.indirect.rel_mse, whole.indirect.rel_mse);

  TechniqueFrames volumes(device(), scene_, std::make_unique<LightVolumePaper>(PaperVariant::kKaplanyan), kSide);
  const Metrics theirs = compare(volumes.next(), under_stairs).indirect;
  const Metrics ours = compare(picture, under_stairs).indirect;
  std::printf("  under the stairs (%ld pixels): relMSE %.4f, paper-lpv %.4f\n", ours.pixels, ours.rel_mse,
              theirs.rel_mse);
  EXPECT_LE(ours.rel_mse, 0.5 * theirs.rel_mse);
}

using LightVolumeBestReferenceTimingTest = LightVolumeBestReferenceTest;

TEST_F(LightVolumeBestReferenceTimingTest, CornellBoxWithASpot) {
  if (!load("cornell_spot", 2.0f)) GTEST_SKIP() << "no reference pictures";
  expect_faster_than_paper();
}

TEST_F(LightVolumeBestReferenceTimingTest, RoomWithWindows) {
  if (!load("room_windows", 1.0f)) GTEST_SKIP() << "no reference pictures";
  expect_faster_than_paper();
}

}  // namespace
}  // namespace lightwell
