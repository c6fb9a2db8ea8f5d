// Which texels of last frame count as a pixel's history.
#include "passes/reprojection/reprojection.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/ext/matrix_transform.hpp>

#include "graph/testing/graph_test.h"
#include "passes/camera/camera.h"
#include "passes/environment/gpu_environment.h"

namespace lightwell {
namespace {

constexpr int kSide = 32;                 // pixels
constexpr float kPixel = 2.0f / kSide;    // side of a pixel in the plane z = 0, m
constexpr std::uint32_t kBilinear = 0xf;  // bits of taps as in history_taps.glsl
constexpr std::uint32_t kTaps = 0x1fff;

// The rectangle [x0, x1] x [-1, 1] in the plane z = 0, as a node of its own.
void add_rectangle(Scene& scene, float x0, float x1, int material) {
  Primitive primitive;
  primitive.positions = {{x0, -1, 0}, {x1, -1, 0}, {x1, 1, 0}, {x0, 1, 0}};
  primitive.normals.assign(4, {0, 0, 1});
  primitive.indices = {0, 1, 2, 0, 2, 3};
  primitive.material = material;
  Node node;
  node.mesh = static_cast<int>(scene.meshes.size());
  scene.meshes.push_back({"rectangle", {primitive}, {}});
  scene.nodes.push_back(node);
}

class ReprojectionTest : public GraphTest {
 protected:
  // A camera that sees [-1, 1] x [-1, 1] of the plane z = 0, `moved` pixels to the right and as many down.
  static WorldCamera camera_at(float moved) {
    WorldCamera camera;
    camera.position = {moved * kPixel, -moved * kPixel, 2};
    camera.yfov = 2.0f * std::atan(0.5f);
    return camera;
  }

  void show(const Scene& scene) {
    snapshot = take_snapshot(scene);
    gpu_scene_.emplace(device(), scene, snapshot);
    environment_.emplace(device(), scene.environment);
  }

  // Bits of the next frame's taps, row by row from the top.
  std::vector<std::uint32_t> next(const WorldCamera& camera, bool reset = false) {
    FrameGraph graph(executor().context());
    const FrameGraph::Scope view = graph.enter("", reset);
    const glsl::GpuCamera gpu_camera =
        make_gpu_camera(camera, {kSide, kSide}, {}, last_camera_ ? &*last_camera_ : nullptr);
    last_camera_ = gpu_camera;
    const BufferHandle camera_handle = graph.upload("camera", std::span(&gpu_camera, 1));
    const GpuScene::Frame scene = gpu_scene_->record(graph, snapshot);
    const ImageHandle environment = environment_->record(graph);
    const GBuffer gbuffer =
        record_gbuffer(graph, scene, camera_handle, environment, kSide, kSide, environment_->constant_radiance());
    const ReadbackTicket taps = graph.read_back(record_reprojection(graph, gbuffer, gpu_camera).taps);
    run(graph);
    return fetch<std::uint32_t>(taps);
  }

  SceneSnapshot snapshot;  // of the next frame

 private:
  std::optional<GpuScene> gpu_scene_;
  std::optional<GpuEnvironment> environment_;
  std::optional<glsl::GpuCamera> last_camera_;
};

TEST_F(ReprojectionTest, WithoutAFrameBeforeEveryTapIsRejected) {
  Scene scene;
  scene.materials.resize(1);
  add_rectangle(scene, -2, 2, 0);
  show(scene);
  EXPECT_EQ(next(camera_at(0)), std::vector<std::uint32_t>(kSide * kSide, 0));
  EXPECT_EQ(next(camera_at(0)), std::vector<std::uint32_t>(kSide * kSide, 1));  // each pixel itself
  EXPECT_EQ(next(camera_at(0), true), std::vector<std::uint32_t>(kSide * kSide, 0));
}

class ManyMaterials : public ReprojectionTest, public ::testing::WithParamInterface<int> {};

// Two rectangles that touch and differ in nothing but the last bit of their material's index.
TEST_P(ManyMaterials, AHistoryStaysWithinItsMaterial) {
  Scene scene;
  scene.materials.resize(static_cast<std::size_t>(GetParam()));
  add_rectangle(scene, -2, 0, GetParam() - 2);
  add_rectangle(scene, 0, 2, GetParam() - 1);
  show(scene);
  next(camera_at(0));
  const std::vector<std::uint32_t> taps = next(camera_at(0.25f));
  const auto is_right = [](int x) { return x >= kSide / 2; };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      // A quarter of a pixel to the right and below, hence among the texels x, x + 1 and y, y + 1.
      std::uint32_t expected = 0;
      for (int i = 0; i < 4; ++i) {
        const int tap_x = x + i % 2, tap_y = y + i / 2;
        if (tap_x < kSide && tap_y < kSide && is_right(tap_x) == is_right(x)) expected |= 1u << i;
      }
      ASSERT_EQ(taps[static_cast<std::size_t>(y * kSide + x)], expected) << x << ", " << y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, ManyMaterials, ::testing::Values(2, 3000, 65535));

// A board before a wall moves to the right by 6 pixels: its history goes along, and what it uncovers has none.
TEST_F(ReprojectionTest, AMovingSurfaceTakesItsHistoryAlong) {
  Scene scene;
  scene.materials.resize(1);
  add_rectangle(scene, -2, 2, 0);
  add_rectangle(scene, -8 * kPixel, 0, 0);
  scene.nodes[0].translation = {0, 0, -1};
  show(scene);
  next(camera_at(0));
  snapshot.instances[1].to_world = glm::translate(snapshot.instances[1].to_world, {6 * kPixel, 0, 0});
  const std::vector<std::uint32_t> taps = next(camera_at(0));
  const auto row = taps.begin() + kSide / 2 * kSide;
  // Columns 8 to 15 showed the board, 14 to 21 show it.
  for (int x = 0; x < kSide; ++x) {
    const bool is_board = x >= 14 && x < 22, was_board = x >= 8 && x < 14;
    if (is_board) {
      EXPECT_NE(row[x] & kBilinear, 0u) << x;
    } else if (!was_board) {
      EXPECT_EQ(row[x], 1u) << x;
    } else if (x > 8) {  // column 7 lends its history to column 8
      EXPECT_EQ(row[x] & kTaps, 0u) << x;
    }
  }
}

}  // namespace
}  // namespace lightwell
