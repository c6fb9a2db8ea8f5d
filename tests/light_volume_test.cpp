// light_volume against pictures by another renderer. Skipped by name where those are not at hand.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "graph/testing/device_test.h"
#include "lightwell/metrics.h"
#include "lightwell/renderer.h"
#include "lightwell/scene.h"

namespace lightwell {
namespace {

constexpr int kSide = 256;  // of the reference pictures

struct Reference {
  const char* name;
  float exposure;  // of its scene.json
};
constexpr Reference kCornellSpot{"cornell_spot", 2.0f};
constexpr Reference kRoom{"room_windows", 1.0f};

class LightVolumeTest : public DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << folder_ << " is not here";
  }

  std::string file(const Reference& reference, const std::string& name) const {
    return folder_ + "/" + reference.name + "/" + name;
  }

  // Rendered once for all tests that look at it.
  const Picture& render(const Reference& reference, const std::string& preset, int resolution) {
    static std::map<std::string, Picture> pictures;
    Picture& picture = pictures[std::string(reference.name) + preset + std::to_string(resolution)];
    if (picture.combined.width > 0) return picture;
    load(reference);
    RendererOptions options;
    options.width = options.height = kSide;
    options.technique = "light-volume";
    options.preset = preset;
    options.technique_options = {"resolution=" + std::to_string(resolution)};
    options.samples = 4;
    picture = Renderer(device(), scene_, snapshot_, options).render({&snapshot_, snapshot_.cameras.at(0)});
    return picture;
  }

  void load(const Reference& reference) {
    scene_ = load_scene(file(reference, std::string(reference.name) + ".glb"));
    snapshot_ = take_snapshot(scene_);
  }

  // 1 where the pixel's world position and normal pass.
  Image select(const Picture& picture, const std::function<bool(glm::vec3, glm::vec3)>& passes) const {
    const WorldCamera& camera = snapshot_.cameras.at(0);
    const glm::vec3 right = glm::cross(camera.forward, camera.up);
    const float scale = std::tan(0.5f * camera.yfov);
    Image mask(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const float u = (2.0f * (static_cast<float>(x) + 0.5f) / kSide - 1.0f) * scale;
        const float v = (1.0f - 2.0f * (static_cast<float>(y) + 0.5f) / kSide) * scale;
        const float depth = *picture.depth.at(x, y);
        const glm::vec3 position = camera.position + depth * (camera.forward + u * right + v * camera.up);
        const float* n = picture.normal.at(x, y);
        const float value = depth > 0.0f && passes(position, {n[0], n[1], n[2]}) ? 1.0f : 0.0f;
        for (int c = 0; c < 3; ++c) mask.at(x, y)[c] = value;
      }
    }
    return mask;
  }

  Metrics indirect(const Reference& reference, const Picture& picture, const Image* mask = nullptr) const {
    MetricOptions options;
    options.mask = mask;
    return compute_metrics(picture.indirect, load_image(file(reference, "cam0_indirect.exr")), options);
  }

  void check_energy(const Reference& reference) {
    load(reference);
    const Picture& picture = render(reference, "best", 32);
    const glm::vec3 towards_camera = -snapshot_.cameras.at(0).forward;
    const Image ceiling = select(picture, [](glm::vec3, glm::vec3 n) { return n.y < -0.99f; });
    const Image back = select(picture, [&](glm::vec3, glm::vec3 n) { return glm::dot(n, towards_camera) > 0.98f; });
    for (const Image* region : {static_cast<const Image*>(nullptr), &ceiling, &back}) {
      const double energy = indirect(reference, picture, region).energy;
      EXPECT_GT(energy, 0.85) << reference.name;
      EXPECT_LT(energy, 1.15) << reference.name;
    }
    MetricOptions options;
    options.exposure = reference.exposure;
    const Image truth = load_image(file(reference, "cam0_combined.exr"));
    EXPECT_GE(compute_metrics(picture.combined, truth, options).ssim, 0.85) << reference.name;
    // The reference's own noise hides in both, so it does not change which is lower.
    const double fine = indirect(reference, render(reference, "best", 64)).rel_mse;
    const double coarse = indirect(reference, picture).rel_mse;
    std::printf("%s: relMSE %.5f at 32^3, %.5f at 64^3\n", reference.name, coarse, fine);
    EXPECT_LT(fine, coarse) << reference.name;
  }

  std::string folder_ = std::string(LIGHTWELL_SHARED_DIR) + "/references";
  Scene scene_;
  SceneSnapshot snapshot_;
};

TEST_F(LightVolumeTest, CornellSpotHasTheLightOfTheReference) {
  check_energy(kCornellSpot);
}
TEST_F(LightVolumeTest, RoomHasTheLightOfTheReference) {
  check_energy(kRoom);
}

TEST_F(LightVolumeTest, UnderTheStairsIsAtLeastTwiceAsCloseAsPropagationVolumes) {
  load(kRoom);
  const Picture& best = render(kRoom, "best", 32);
  // The flight rises from z = 5 m towards z = 0.9 m, 0.3 m on every 0.36 m, along the wall at x = 8 m.
  const Image mask = select(best, [](glm::vec3 p, glm::vec3) {
    return p.x > 6.4f && p.z > 0.9f && p.z < 4.6f && p.y < (5.0f - p.z) / 0.36f * 0.3f - 0.3f;
  });
  const double ours = indirect(kRoom, best, &mask).rel_mse;
  const double theirs = indirect(kRoom, render(kRoom, "paper-lpv", 32), &mask).rel_mse;
  EXPECT_LE(ours, 0.5 * theirs);
}

}  // namespace
}  // namespace lightwell
