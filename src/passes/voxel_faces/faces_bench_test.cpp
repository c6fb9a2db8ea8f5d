// Measures making the faces of Crytek Sponza, and keeping them while a ball moves in it; not part of the test run:
//   lightwell_passes_test --gtest_also_run_disabled_tests --gtest_filter='*VoxelFacesBench.*'
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

#include "passes/voxel_faces/testing/faces_test_base.h"

namespace lightwell {
namespace {

class DISABLED_VoxelFacesBench : public VoxelFacesTest {};

// The scene's last instance: 4096 triangles, 1 m across.
void add_ball(Scene& scene) {
  constexpr int kSide = 64;
  constexpr float kPi = 3.14159265f;
  Primitive ball;
  for (int y = 0; y <= kSide / 2; ++y)
    for (int x = 0; x <= kSide; ++x) {
      const float a = 2.0f * kPi * static_cast<float>(x) / kSide;
      const float b = 2.0f * kPi * static_cast<float>(y) / kSide;
      const glm::vec3 n(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
      ball.positions.push_back(0.5f * n);
      ball.normals.push_back(n);
    }
  for (std::uint32_t y = 0; y < kSide / 2; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t i = y * (kSide + 1) + x;
      for (const std::uint32_t k : {i, i + 1, i + kSide + 1, i + 1, i + kSide + 2, i + kSide + 1})
        ball.indices.push_back(k);
    }
  Node node;
  node.mesh = static_cast<int>(scene.meshes.size());
  scene.meshes.push_back({"ball", {ball}, {}});
  scene.nodes.push_back(node);
}

TEST_F(DISABLED_VoxelFacesBench, ABallInSponza) {
  const std::string path = LIGHTWELL_SHARED_DIR "/scenes/sponza-crytek/sponza-crytek.gltf";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  Scene scene = load_scene(path, {.scale = 0.01f});
  add_ball(scene);
  SceneSnapshot snapshot = take_snapshot(scene);
  snapshot.instances.back().to_world[3].y = 2.0f;
  for (const std::uint32_t resolution : {64u, 128u, 256u}) {
    for (const bool areas : {false, true}) {
      GpuScene gpu_scene(device(), scene, snapshot);
      const VoxelFaceSettings settings{.levels = {.resolution = resolution}, .areas = areas};
      const std::string scope = std::to_string(resolution) + (areas ? " with areas: " : ": ");
      VoxelFaceMemory memory;
      const auto show_frame = [&](const char* what, bool print) {
        FrameGraph graph(executor().context());
        const auto scoped = graph.enter(scope, false);
        const GpuScene::Frame frame = gpu_scene.record(graph, snapshot);
        const VoxelFaces faces = record_voxel_faces(graph, frame, snapshot.bounds, {}, settings, memory);
        const ReadbackTicket counts = graph.read_back(faces.counts);
        if (faces.before) graph.read_back(faces.before);  // or nothing of it would be run
        run(graph);
        const auto words = fetch<std::uint32_t>(counts);
        std::map<std::string, double> times;
        double sum = 0.0;
        for (const PassTime& pass : executor().pass_times(frame_)) {
          if (!pass.name.starts_with("vox")) continue;
          times[pass.name] += pass.time_ms;
          sum += pass.time_ms;
        }
        if (!print) return;
        std::printf("%-20s %-22s %9.2f ms, %u of %u faces;", scope.c_str(), what, sum, words[glsl::kFacesStored],
                    words[glsl::kFacesFound]);
        for (const auto& [name, time] : times) std::printf(" %s %.2f", name.c_str(), time);
        std::printf("\n");
      };
      // Twice, for drivers compile in the first frames.
      for (const bool print : {false, true}) {
        memory = {};
        show_frame("all, from nothing", print);
        snapshot.instances.back().to_world[3].x += 0.05f;
        show_frame("something begins to move", print);
        for (int i = 0; i < 2; ++i) {
          snapshot.instances.back().to_world[3].x += 0.05f;
          show_frame("it moves on", print);
        }
        for (int i = 0; i < 70; ++i) show_frame("", false);
        show_frame("nothing moves", print);
      }
    }
  }
}

}  // namespace
}  // namespace lightwell
