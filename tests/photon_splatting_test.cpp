// photon_splatting against the path tracer.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "graph/testing/device_test.h"
#include "lightwell/metrics.h"
#include "lightwell/path_tracer.h"
#include "lightwell/renderer.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

using OptionList = std::vector<std::string>;

class PhotonSplattingImageTest : public DeviceTest {
 protected:
  void load(const std::string& name) {
    scene_ = load_scene(resolve_scene(name));
    world_ = take_snapshot(scene_);
    camera_ = world_.cameras.at(0);
  }

  void use_camera(const std::string& name) {
    for (const WorldCamera& camera : world_.cameras)
      if (camera.name == name) camera_ = camera;
    ASSERT_EQ(camera_.name, name);
  }

  // The mean of `frames` frames.
  Image render(int width, int height, const OptionList& technique_options, int frames,
               const std::string& preset = "best") {
    RendererOptions o;
    o.width = width;
    o.height = height;
    o.technique = "photon-splatting";
    o.preset = preset;
    o.technique_options = technique_options;
    o.frames = o.samples = frames;
    return Renderer(device(), scene_, world_, o).render({&world_, camera_}).indirect;
  }

  Image trace(int side, int samples, int bounces = 8) const {
    PathTracerOptions o;
    o.width = o.height = side;
    o.samples = samples;
    o.max_bounces = bounces;
    return PathTracer(scene_, world_).render(camera_, o).indirect;
  }

  static double mean_of(const Image& image) {
    double sum = 0.0;
    for (const float value : image.pixels) sum += value;
    return sum / static_cast<double>(image.pixels.size());
  }

  Scene scene_;
  SceneSnapshot world_;
  WorldCamera camera_;
};

TEST_F(PhotonSplattingImageTest, AgreesWithThePathTracer) {
  for (const auto& [name, least_ssim] : {std::pair{"cornell-spot", 0.95}, {"room", 0.9}}) {
    load(name);
    const Metrics m =
        compute_metrics(render(80, 80, {"photons=8192"}, 16), trace(80, 512), {.exposure = 2.0f, .block = 4});
    EXPECT_NEAR(m.energy, 1.0, 0.05) << name;
    EXPECT_GE(m.ssim, least_ssim) << name;
  }
}

TEST_F(PhotonSplattingImageTest, EachBounceAddsWhatThePathTracerSays) {
  load("cornell-spot");
  double last = 0.0;
  double last_truth = 0.0;
  for (const int bounces : {1, 2, 3}) {
    const double mean = mean_of(render(48, 48, {"bounces=" + std::to_string(bounces), "photons=2048"}, 16));
    const double truth = mean_of(trace(48, 512, bounces));
    EXPECT_NEAR((mean - last) / (truth - last_truth), 1.0, 0.1) << bounces << " bounces";
    last = mean;
    last_truth = truth;
  }
}

// The published preset has no unit: least squares find its factor.
TEST_F(PhotonSplattingImageTest, ThePublishedPresetResemblesTheTruth) {
  load("cornell-spot");
  const Image truth = trace(64, 256, 1);
  Image picture = render(64, 64, {}, 1, "paper");
  double mixed = 0.0, square = 0.0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    mixed += double{truth.pixels[i]} * picture.pixels[i];
    square += double{picture.pixels[i]} * picture.pixels[i];
  }
  for (float& value : picture.pixels) value *= static_cast<float>(mixed / square);
  EXPECT_GE(compute_metrics(picture, truth, {.exposure = 2.0f, .block = 4}).ssim, 0.5);
}

TEST_F(PhotonSplattingImageTest, NoLightComesThroughAWall) {
  load("two-rooms");
  use_camera("lit");
  const OptionList few{"photons=4096"};
  const double lit = mean_of(render(48, 48, few, 4));
  use_camera("sealed");
  EXPECT_LE(mean_of(render(48, 48, few, 4)), 0.01 * lit);  // a texel of a map may span the wall
}

TEST_F(PhotonSplattingImageTest, TakesAnySize) {
  load("cornell-spot");
  for (const char* preset : {"best", "paper"})
    for (const auto& [width, height] : {std::pair{1, 1}, {17, 13}, {5, 64}})
      for (const float value : render(width, height, {"photons=1024"}, 2, preset).pixels)
        ASSERT_TRUE(std::isfinite(value) && value >= 0.0f);
}

}  // namespace
}  // namespace lightwell
