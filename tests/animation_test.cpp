// Nothing lags: a frame of an animation, rendered after the frames before it, is the frame rendered alone.
#include <gtest/gtest.h>

#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include "animated_scene.h"
#include "graph/testing/device_test.h"
#include "lightwell/metrics.h"
#include "lightwell/path_tracer.h"
#include "lightwell/renderer.h"

namespace lightwell {
namespace {

// What is rendered, and what must come out the same to the last bit whatever was rendered before.
struct Case {
  const char* name;
  const char* technique;
  const char* preset;
  int shadows;  // RendererOptions::shadows
  std::vector<std::string> exact_views;
  bool exact_picture;
};

// The test's name.
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class AnimationTest : public DeviceTest {
 protected:
  RendererOptions make_options(const Case& c) const {
    RendererOptions options;
    options.width = options.height = 96;
    options.technique = c.technique;
    options.preset = c.preset;
    options.shadows = c.shadows;
    options.shadow_map_size = 256;
    options.samples = options.frames = 1;
    options.debug_views = c.exact_views;
    if (options.technique == "light-volume") options.technique_options = {"resolution=16"};
    return options;
  }

  Renderer make_renderer(const Case& c, const SceneSnapshot& first) {
    return Renderer(device(), animated_.scene(), first, make_options(c));
  }

  static Picture render(Renderer& renderer, const SceneSnapshot& snapshot) {
    return renderer.render({&snapshot, snapshot.cameras.at(0)});
  }

  AnimatedScene animated_;
};

class FollowsAtOnce : public AnimationTest, public ::testing::WithParamInterface<Case> {};

// One renderer plays from frame 0 on; at some frames a new one, which has seen nothing, must agree.
TEST_P(FollowsAtOnce, AfterTheFramesBefore) {
  const Case& c = GetParam();
  Renderer playing = make_renderer(c, animated_.frame(0));
  Image last;
  for (int frame = 0; frame <= 5; ++frame) {
    const SceneSnapshot now = animated_.frame(frame);
    const Picture played = render(playing, now);
    EXPECT_NE(played.depth.pixels, last.pixels) << "nothing moved, frame " << frame;
    last = played.depth;
    if (frame != 1 && frame != 5) continue;
    Renderer alone = make_renderer(c, now);
    const Picture expected = render(alone, now);
    EXPECT_EQ(played.direct.pixels, expected.direct.pixels) << "frame " << frame;
    EXPECT_EQ(played.albedo.pixels, expected.albedo.pixels) << "frame " << frame;
    EXPECT_EQ(played.normal.pixels, expected.normal.pixels) << "frame " << frame;
    EXPECT_EQ(played.depth.pixels, expected.depth.pixels) << "frame " << frame;
    EXPECT_EQ(c.exact_picture ? played.combined.pixels : expected.combined.pixels, expected.combined.pixels)
        << "frame " << frame;
    for (const std::string& view : c.exact_views)
      EXPECT_EQ(playing.debug_images().at(view).pixels, alone.debug_images().at(view).pixels)
          << view << ", frame " << frame;
  }
}

// `best` keeps its light and its links from frame to frame.
INSTANTIATE_TEST_SUITE_P(Techniques, FollowsAtOnce,
                         ::testing::Values(Case{"none", "none", "", 0, {"position", "shadow-atlas"}, true},
                                           Case{"rays", "none", "", 1, {"position"}, true},
                                           Case{"paper", "light-volume", "paper", 0, {}, true},
                                           Case{"best", "light-volume", "best", 0, {}, false}),
                         ::testing::PrintToStringParamName());

// Frame 0 is far back when frame 24 comes: a jump, as of a host that drops frames.
TEST_F(AnimationTest, FollowsAJump) {
  const Case c{"jump", "none", "", 0, {"shadow-atlas"}, true};
  Renderer playing = make_renderer(c, animated_.frame(0));
  render(playing, animated_.frame(0));
  const SceneSnapshot now = animated_.frame(24);
  const Picture played = render(playing, now);
  Renderer alone = make_renderer(c, now);
  EXPECT_EQ(played.combined.pixels, render(alone, now).combined.pixels);
  EXPECT_EQ(playing.debug_images().at("shadow-atlas").pixels, alone.debug_images().at("shadow-atlas").pixels);
}

// `best` remembers links and light: while things move, some links are of the frames before. Once all is static, it
// forgets them: then its picture is that of a renderer that never saw another frame, but for the noise of other rays.
TEST_F(AnimationTest, BestForgetsOnceAllIsStatic) {
  const Case c{"best", "light-volume", "best", 0, {}, false};
  RendererOptions options = make_options(c);
  options.technique_options.push_back("links=128");
  constexpr int kFramesUntilForgotten = 32;  // 16 that trace all links, and bounces
  const SceneSnapshot first = animated_.frame(20), now = animated_.frame(24);
  Renderer playing(device(), animated_.scene(), first, options);
  for (int frame = 20; frame < 24; ++frame) render(playing, animated_.frame(frame));
  const Picture lagging = render(playing, now);
  Renderer alone(device(), animated_.scene(), now, options);
  Picture played, expected;
  for (int still = 0; still < kFramesUntilForgotten; ++still) {
    played = render(playing, now);
    expected = render(alone, now);
  }
  const Metrics metrics = compute_metrics(played.indirect, expected.indirect);
  const Metrics lag = compute_metrics(lagging.indirect, expected.indirect);
  std::printf("relMSE %.6f, in motion %.6f; energy %.4f, in motion %.4f\n", metrics.rel_mse, lag.rel_mse,
              metrics.energy, lag.energy);
  EXPECT_GT(metrics.mean_reference, 0.0);
  EXPECT_NEAR(metrics.energy, 1.0, 0.005);
  EXPECT_LT(metrics.rel_mse, 0.001);
  EXPECT_NEAR(lag.energy, 1.0, 0.06);
  EXPECT_LT(lag.rel_mse, 0.005);
}

class DirectLightMoves : public AnimationTest, public ::testing::WithParamInterface<int> {};

// The device's pose and lights against the processor's.
TEST_P(DirectLightMoves, AsThePathTracers) {
  const SceneSnapshot now = animated_.frame(GetParam());
  PathTracerOptions tracer;
  tracer.width = tracer.height = 128;
  tracer.samples = 16;
  tracer.max_bounces = 0;
  const Picture expected = PathTracer(animated_.scene(), now).render(now.cameras.at(0), tracer);
  RendererOptions options;
  options.width = options.height = 128;
  options.samples = 8;
  Renderer renderer(device(), animated_.scene(), animated_.frame(0), options);
  const Metrics metrics = compute_metrics(render(renderer, now).direct, expected.direct);
  RecordProperty("energy", std::to_string(metrics.energy));
  RecordProperty("ssim", std::to_string(metrics.ssim));
  EXPECT_NEAR(metrics.energy, 1.0, 0.01);
  EXPECT_GE(metrics.ssim, 0.97);
}

INSTANTIATE_TEST_SUITE_P(Frames, DirectLightMoves, ::testing::Values(9, 31));

}  // namespace
}  // namespace lightwell
