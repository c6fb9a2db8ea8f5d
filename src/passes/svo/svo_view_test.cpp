// The picture of the octree: where boxes are, in which colour.
#include "passes/svo/svo_view.h"

#include <gtest/gtest.h>

#include <glm/gtc/packing.hpp>

#include "lightwell/image.h"
#include "passes/svo/testing/svo_test_base.h"

namespace lightwell {
namespace {

class SvoViewTest : public SvoTest {
 protected:
  // Linear RGBA, of a scene's first camera.
  std::vector<glm::vec4> picture(const Scene& scene, std::uint32_t resolution, glm::uvec2 size) {
    const SceneSnapshot snapshot = take_snapshot(scene);
    World world(device(), scene, snapshot, {});
    FrameGraph graph(executor().context());
    WorldFrame frame(graph, world, snapshot, 0.0);
    const WorldCamera camera = snapshot.cameras.empty() ? default_camera(snapshot.bounds) : snapshot.cameras[0];
    ViewFrame view(graph, frame, size, camera, PixelSample{}, nullptr);
    const Svo svo = record_svo(graph, frame.scene, snapshot.bounds, {.resolution = resolution});
    const ReadbackTicket ticket = graph.read_back(record_svo_view(graph, view, svo));
    const ReadbackTicket positions = graph.read_back(view.gbuffer.position);
    run(graph);
    position = fetch<glm::vec4>(positions);
    std::vector<glm::vec4> pixels;
    for (const std::uint64_t texel : fetch<std::uint64_t>(ticket)) pixels.push_back(glm::unpackHalf4x16(texel));
    return pixels;
  }

  std::vector<glm::vec4> position;  // G-buffer of the last picture
};

// Leaves cover every surface that the camera sees; there are edges of both kinds.
TEST_F(SvoViewTest, BoxesCoverTheScene) {
  constexpr std::uint32_t kSide = 128;
  const std::vector<glm::vec4> pixels =
      picture(load_scene(LIGHTWELL_SOURCE_DIR "/scenes/cornell-spot.gltf"), 32, {kSide, kSide});
  std::size_t green = 0, blue = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (position[i].w > 0.0f) {
      EXPECT_EQ(pixels[i].a, 1.0f) << i;
    }
    green += pixels[i].g > 0.5f ? 1 : 0;
    blue += pixels[i].b > 0.5f ? 1 : 0;
  }
  EXPECT_GT(green, pixels.size() / 50);
  EXPECT_GT(blue, pixels.size() / 50);
}

// Not part of the run; writes svo.png where it is started.
TEST_F(SvoViewTest, DISABLED_PictureOfCornellDynamic) {
  const glm::uvec2 size(768, 768);
  const std::vector<glm::vec4> pixels =
      picture(load_scene(LIGHTWELL_SOURCE_DIR "/scenes/cornell-dynamic.glb"), 64, size);
  Image image(size.x, size.y, 3);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = pixels[i][static_cast<int>(c)];
  save_png("svo.png", image);
}

}  // namespace
}  // namespace lightwell
