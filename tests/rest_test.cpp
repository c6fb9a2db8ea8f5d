// A body that a host moved and left where it is: when its triangles are static again, nothing of that shows.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "graph/testing/device_test.h"
#include "lightwell/renderer.h"
#include "passes/gpu_scene/scene_motion.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

struct Case {
  const char* name;
  const char* technique;
  int shadows;  // RendererOptions::shadows
  std::vector<std::string> technique_options;
  std::uint32_t frames_until_steady;  // at least kStillFramesUntilStatic
};

// The test's name.
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class RestTest : public DeviceTest, public ::testing::WithParamInterface<Case> {};

TEST_P(RestTest, ReturningToTheStaticTrianglesDoesNotShow) {
  RendererOptions options;
  options.width = options.height = 48;
  options.technique = GetParam().technique;
  options.technique_options = GetParam().technique_options;
  options.shadows = GetParam().shadows;
  options.samples = options.frames = 1;
  const Scene scene = load_scene(resolve_scene("cornell-spot"));
  SceneSnapshot snapshot = take_snapshot(scene);
  Renderer renderer(device(), scene, snapshot, options);
  const auto render = [&] { return renderer.render({&snapshot, snapshot.cameras.at(0)}); };
  const Picture before = render();
  snapshot.instances.back().to_world[3].x += 0.05f;
  EXPECT_NE(render().combined.pixels, before.combined.pixels);
  Picture still;
  for (std::uint32_t i = 0; i < GetParam().frames_until_steady; ++i) still = render();
  EXPECT_TRUE(renderer.statistics().steady);
  for (int i = 0; i < 3; ++i) {  // static again in the first, if not before
    EXPECT_EQ(render().combined.pixels, still.combined.pixels) << i;
    EXPECT_TRUE(renderer.statistics().steady);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Techniques, RestTest,
    ::testing::Values(Case{"maps", "none", 0, {}, kStillFramesUntilStatic},
                      Case{"rays", "none", 1, {}, kStillFramesUntilStatic},
                      // Four frames that trace all links, 32 in which faces are asked for, and 64 bounces.
                      Case{"best", "light-volume", 1, {"resolution=16", "links=32"}, 100}),
    ::testing::PrintToStringParamName());

}  // namespace
}  // namespace lightwell
