// The path tracer against images made by another renderer (Blender Cycles), in ../shared/references. Both are Monte
// Carlo estimates: the mean of a picture is compared, to 1 %.
#include <filesystem>
#include <iostream>

#include <gtest/gtest.h>

#include "lightwell/image.h"
#include "lightwell/metrics.h"
#include "lightwell/path_tracer.h"
#include "reference/test_scenes.h"

namespace lightwell {
namespace {

constexpr double kTolerance = 0.01;
constexpr int kSide = 128;  // pixels; the references, 256 x 256, are averaged 2 x 2, which is exact for a box filter

Image halve(const Image& image) {
  Image half(image.width / 2, image.height / 2, image.channels);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      for (int c = 0; c < image.channels; ++c) {
        half.at(x, y)[c] = 0.25f * (image.at(2 * x, 2 * y)[c] + image.at(2 * x + 1, 2 * y)[c] +
                                    image.at(2 * x, 2 * y + 1)[c] + image.at(2 * x + 1, 2 * y + 1)[c]);
      }
    }
  }
  return half;
}

class SharedReference : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    folder_ = std::string(LIGHTWELL_SHARED_DIR) + "/references/" + GetParam();
    if (!std::filesystem::is_directory(folder_)) GTEST_SKIP() << "no reference images: " << folder_ << " is missing";
    scene_ = load_scene(folder_ + "/" + GetParam() + ".glb");
    snapshot_ = take_snapshot(scene_);
    ASSERT_EQ(snapshot_.cameras.size(), 1u);
  }

  Picture render(int samples, int max_bounces) const {
    return PathTracer(scene_, snapshot_).render(snapshot_.cameras[0], test_options(kSide, samples, max_bounces));
  }

  std::string file(const std::string& kind) const { return folder_ + "/cam0_" + kind + ".exr"; }

  void expect_same_energy(const Image& image, const std::string& kind) const {
    const Metrics metrics = compute_metrics(image, halve(load_image(file(kind))));
    std::cout << GetParam() << " " << kind << ": energy " << metrics.energy << " (R " << metrics.energy_rgb[0] << ", G "
              << metrics.energy_rgb[1] << ", B " << metrics.energy_rgb[2] << "), relMSE " << metrics.rel_mse << "\n";
    EXPECT_NEAR(metrics.energy, 1.0, kTolerance) << kind;
    for (const double energy : metrics.energy_rgb) EXPECT_NEAR(energy, 1.0, kTolerance) << kind;
  }

  std::string folder_;
  Scene scene_;
  SceneSnapshot snapshot_;
};

TEST_P(SharedReference, DirectIndirectAndCombined) {
  const Picture picture = render(128, 32);
  expect_same_energy(picture.direct, "direct");
  expect_same_energy(picture.indirect, "indirect");
  expect_same_energy(picture.combined, "combined");
}

// cornell_original has no pictures with few bounces.
class SharedReferenceWithFewBounces : public SharedReference {};

TEST_P(SharedReferenceWithFewBounces, OneAndTwoBounces) {
  expect_same_energy(render(128, 1).combined, "combined_b1");
  expect_same_energy(render(128, 2).combined, "combined_b2");
}

INSTANTIATE_TEST_SUITE_P(Scenes, SharedReference, testing::Values("cornell_original", "cornell_spot", "room_windows"),
                         [](const auto& test) { return test.param; });
INSTANTIATE_TEST_SUITE_P(Scenes, SharedReferenceWithFewBounces, testing::Values("cornell_spot", "room_windows"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lightwell
