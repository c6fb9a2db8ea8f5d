// many_light against the path tracer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "gi_scenes.h"
#include "graph/testing/device_test.h"
#include "lightwell/metrics.h"
#include "lightwell/path_tracer.h"
#include "lightwell/renderer.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

using OptionList = std::vector<std::string>;

// A frame by itself, as it was sampled.
const OptionList kNoMemory{"history=0", "filter=off"};

OptionList operator+(OptionList a, const OptionList& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

double mean_of(const Image& image) {
  double sum = 0.0;
  for (const float value : image.pixels) sum += value;
  return sum / static_cast<double>(image.pixels.size());
}

class ManyLightTest : public DeviceTest {
 protected:
  void load(const std::string& name) {
    scene_ = load_scene(resolve_scene(name));
    world_ = take_snapshot(scene_);
    camera_ = world_.cameras.at(0);
  }

  void use_camera(const std::string& name) {
    const auto found =
        std::find_if(world_.cameras.begin(), world_.cameras.end(), [&](const auto& c) { return c.name == name; });
    ASSERT_NE(found, world_.cameras.end());
    camera_ = *found;
  }

  RendererOptions options(int side, const OptionList& technique_options, const std::string& preset = "best") const {
    RendererOptions options;
    options.width = options.height = side;
    options.technique = "many-light";
    options.preset = preset;
    options.technique_options = technique_options;
    return options;
  }

  // The mean of `frames` frames; where that is 0, a steady picture.
  Picture render(int side, const OptionList& technique_options, int frames, const std::string& preset = "best") {
    RendererOptions o = options(side, technique_options, preset);
    o.frames = frames;
    o.samples = frames > 0 ? frames : 4;
    return Renderer(device(), scene_, world_, o).render({&world_, camera_});
  }

  Picture trace(int side, int samples, int bounces = 8) const {
    PathTracerOptions o;
    o.width = o.height = side;
    o.samples = samples;
    o.max_bounces = bounces;
    return PathTracer(scene_, world_).render(camera_, o);
  }

  Scene scene_;
  SceneSnapshot world_;
  WorldCamera camera_;
};

// No history, no filter: whatever the sampler has learned, the mean of many frames is the truth.
TEST_F(ManyLightTest, TheMeanOfIndependentFramesIsTheTruth) {
  for (const auto& [name, samples] : {std::pair{"cornell-spot", 2048}, {"cornell-box", 512}, {"room", 8192}}) {
    load(name);
    const double test = mean_of(render(24, kNoMemory, 256).indirect);
    EXPECT_NEAR(test / mean_of(trace(24, samples).indirect), 1.0, 0.01) << name;
  }
}

class ManyLightSceneTest : public ManyLightTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(ManyLightSceneTest, TheMeanOfIndependentFramesIsTheTruth) {
  const std::string name = GetParam();
  std::optional<GiScene> gi = load_gi_scene(name);
  if (!gi) GTEST_SKIP() << name << "'s file is not here";
  // Not smaller: rays start a fiftieth of a pixel above what is seen, which costs light where pixels are coarse.
  constexpr int kSide = 128;
  scene_ = std::move(gi->scene);
  world_ = std::move(gi->world);
  camera_ = gi->cameras.at("own");
  const double test = mean_of(render(kSide, kNoMemory, 256).indirect);
  EXPECT_NEAR(test / mean_of(trace(kSide, 256).indirect), 1.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ManyLightSceneTest, ::testing::Values("sibenik", "conference"));

TEST_F(ManyLightTest, EachBounceAddsWhatThePathTracerSays) {
  load("cornell-spot");
  double last = 0.0;
  double last_truth = 0.0;
  for (const int bounces : {1, 2, 3}) {
    const double mean = mean_of(render(32, kNoMemory + OptionList{"bounces=" + std::to_string(bounces)}, 128).indirect);
    const double truth = mean_of(trace(32, 1024, bounces).indirect);
    EXPECT_NEAR((mean - last) / (truth - last_truth), 1.0, 0.1) << bounces << " bounces";
    last = mean;
    last_truth = truth;
  }
}

TEST_F(ManyLightTest, AgreesWithThePathTracer) {
  for (const char* name : {"cornell-spot", "room"}) {
    load(name);
    const Metrics m =
        compute_metrics(render(96, {}, 0).indirect, trace(96, 512).indirect, {.exposure = 2.0f, .block = 4});
    EXPECT_NEAR(m.energy, 1.0, 0.03) << name;
    EXPECT_GE(m.ssim, 0.97) << name;
  }
}

TEST_F(ManyLightTest, OneBounceAgreesWithThePathTracer) {
  load("cornell-spot");
  const Image truth = trace(96, 512, 1).indirect;
  const Metrics best = compute_metrics(render(96, {"bounces=1"}, 16).indirect, truth, {.exposure = 2.0f, .block = 4});
  EXPECT_NEAR(best.energy, 1.0, 0.05);
  EXPECT_GE(best.ssim, 0.95);
  const Metrics paper =
      compute_metrics(render(96, {"vpls=2048"}, 1, "paper").indirect, truth, {.exposure = 2.0f, .block = 4});
  EXPECT_GE(paper.ssim, 0.9);  // its voxels cost light and shadows
}

TEST_F(ManyLightTest, TheFilterKeepsTheLight) {
  load("cornell-spot");
  const double filtered = mean_of(render(64, {"history=0"}, 16).indirect);
  EXPECT_NEAR(filtered / mean_of(render(64, kNoMemory, 16).indirect), 1.0, 0.01);
}

TEST_F(ManyLightTest, NoLightComesThroughAWall) {
  load("two-rooms");
  use_camera("lit");
  const double lit = mean_of(render(48, {}, 8).indirect);
  use_camera("sealed");
  EXPECT_EQ(mean_of(render(48, {}, 8).indirect), 0.0);
  EXPECT_LE(mean_of(render(48, {"visibility=voxels"}, 8).indirect), 0.01 * lit);
}

TEST_F(ManyLightTest, LightIsGoneAtOnceWhereItIsSwitchedOff) {
  load("cornell-spot");
  RendererOptions o = options(48, {});
  o.frames = o.samples = 1;
  Renderer renderer(device(), scene_, world_, o);
  for (int i = 0; i < 12; ++i) EXPECT_GT(mean_of(renderer.render({&world_, camera_}).indirect), 0.0);
  world_.lights.at(0).intensity = glm::vec3(0.0f);
  EXPECT_EQ(mean_of(renderer.render({&world_, camera_}).indirect), 0.0);
}

// A lamp on a circle: pictures follow the truth, and flicker by no more than twice as much as it changes.
TEST_F(ManyLightTest, FollowsALampThatMoves) {
  load("cornell-spot");
  RendererOptions o = options(64, {});
  o.frames = o.samples = 1;
  Renderer renderer(device(), scene_, world_, o);
  SceneSnapshot moved = world_;
  Image last, last_truth;
  double flicker = 0.0, truth_flicker = 0.0;
  for (int i = 0; i < 20; ++i) {
    const float angle = glm::two_pi<float>() * static_cast<float>(i) / 60.0f;
    moved.lights.at(0).position =
        world_.lights.at(0).position + 0.1f * glm::vec3(std::cos(angle), 0.0f, std::sin(angle));
    const Image now = renderer.render({&moved, camera_}).indirect;
    if (i < 12) continue;
    PathTracerOptions p;
    p.width = p.height = 64;
    p.samples = 128;  // the same seed for all: what they differ by is the light
    const Image truth = PathTracer(scene_, moved).render(camera_, p).indirect;
    EXPECT_NEAR(compute_metrics(now, truth).energy, 1.0, 0.06) << "frame " << i;
    for (std::size_t k = 0; k < now.pixels.size() && last.width > 0; ++k) {
      flicker += std::abs(now.pixels[k] - last.pixels[k]);
      truth_flicker += std::abs(truth.pixels[k] - last_truth.pixels[k]);
    }
    last = now;
    last_truth = truth;
  }
  EXPECT_LE(flicker, 2.0 * truth_flicker);
}

TEST_F(ManyLightTest, TheSameFramesGiveTheSameBytes) {
  load("cornell-spot");
  for (const char* preset : {"best", "paper"}) {
    const Image first = render(40, {}, 3, preset).combined;
    EXPECT_EQ(first.pixels, render(40, {}, 3, preset).combined.pixels) << preset;
  }
}

TEST_F(ManyLightTest, TakesAnySizeAndAnyScene) {
  load("cornell-spot");
  for (const char* preset : {"best", "paper"}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {17, 13}, {5, 64}}) {
      RendererOptions o = options(1, {}, preset);
      o.width = width;
      o.height = height;
      o.frames = o.samples = 2;
      const Image picture = Renderer(device(), scene_, world_, o).render({&world_, camera_}).indirect;
      for (const float value : picture.pixels) ASSERT_TRUE(std::isfinite(value) && value >= 0.0f);
    }
    SceneSnapshot dark = world_;
    dark.lights.clear();
    RendererOptions o = options(16, {}, preset);
    o.frames = o.samples = 2;
    EXPECT_EQ(mean_of(Renderer(device(), scene_, dark, o).render({&dark, camera_}).combined), 0.0) << preset;
  }
}

}  // namespace
}  // namespace lightwell
