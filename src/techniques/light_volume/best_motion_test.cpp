// What motion costs beside making all voxels and faces from nothing, in Crytek Sponza: a chair that moves, and a walk
// of a metre where nothing does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "techniques/light_volume/best_test_frames.h"

namespace lightwell {
namespace {

class LightVolumeBestMotionTimingTest : public DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    const std::string path = LIGHTWELL_SHARED_DIR "/scenes/sponza-crytek/sponza-crytek.gltf";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    still_ = load_scene(path, {.scale = 0.01f});
    furnished_ = still_;
    add_chair(furnished_);
  }

  // Boxes of a seat, a back and four legs, 1 m high; the scene's last instance.
  static void add_chair(Scene& scene) {
    Primitive chair;
    const auto add_box = [&](const glm::vec3& low, const glm::vec3& high) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {0.0f, 1.0f}) {
          glm::vec3 normal(0.0f);
          normal[axis] = 2.0f * side - 1.0f;
          const auto first = static_cast<std::uint32_t>(chair.positions.size());
          for (int i = 0; i < 4; ++i) {
            glm::vec3 corner(side);
            corner[(axis + 1) % 3] = static_cast<float>(i & 1);
            corner[(axis + 2) % 3] = static_cast<float>(i >> 1);
            chair.positions.push_back(glm::mix(low, high, corner));
            chair.normals.push_back(normal);
          }
          for (const std::uint32_t index : {0u, 1u, 2u, 2u, 1u, 3u}) chair.indices.push_back(first + index);
        }
      }
    };
    add_box({-0.25f, 0.45f, -0.25f}, {0.25f, 0.5f, 0.25f});
    add_box({-0.25f, 0.5f, -0.25f}, {0.25f, 1.0f, -0.2f});
    for (const float x : {-0.25f, 0.2f})
      for (const float z : {-0.25f, 0.2f}) add_box({x, 0.0f, z}, {x + 0.05f, 0.45f, z + 0.05f});
    Node node{.name = "chair", .mesh = static_cast<int>(scene.meshes.size())};
    node.translation = {1.0f, 0.01f, 0.3f};
    scene.meshes.push_back({.name = "chair", .primitives = {std::move(chair)}, .morph_weights = {}});
    scene.nodes.push_back(node);
  }

  // Milliseconds of all that brings voxels, faces and what they keep up to this frame.
  static double time_of_faces(const TechniquePicture& picture) {
    double sum = 0.0;
    for (const auto& [name, time] : picture.times_ms)
      for (const char* part : {"vox", "light cache: clear", "light cache: carry", "light cache: pages"})
        if (name.starts_with(part)) sum += time;
    return sum;
  }

  // After a frame.
  std::unique_ptr<BestFrames> start(const Scene& scene) {
    auto frames = std::make_unique<BestFrames>(device(), scene, LightVolumeBest::kDefaults, 16);
    frames->camera.position = {-4.0f, 1.7f, 0.0f};
    frames->camera.forward = {1.0f, 0.0f, 0.0f};
    frames->points_of_interest = {frames->camera.position};
    frames->next();
    return frames;
  }

  Scene still_;      // nothing ever moves
  Scene furnished_;  // with a chair
};

// The least of a few frames each, and of more rounds where it is too much: others may use the machine. The
// metre is close to its bound: 0.22 to 0.26 in different runs of one binary.
TEST_F(LightVolumeBestMotionTimingTest, AChairAndAWalkCostAQuarterOfAllFromNothing) {
  constexpr double kMost = 0.25;
  constexpr int kTimes = 6;
  const std::unique_ptr<BestFrames> furnished = start(furnished_);
  const std::unique_ptr<BestFrames> still = start(still_);
  const auto move_chair = [&] { furnished->world.instances.back().to_world[3].x += 0.02f; };
  int steps = 0;
  const auto walk = [&] {
    const float step = ++steps % 8 < 4 ? 1.0f : -1.0f;  // m
    for (glm::vec3* place : {&still->camera.position, &still->points_of_interest[0]}) place->x += step;
  };
  const auto forget = [&] { still->restart = true; };
  const auto measure = [&](BestFrames& frames, const auto& change, double& least) {
    for (int i = 0; i < 2; ++i) frames.next();
    for (int i = 0; i < kTimes; ++i) {
      change();
      least = std::min(least, time_of_faces(frames.next()));
    }
  };
  for (int warm_up = 0; warm_up < 2; ++warm_up) {  // drivers compile kernels where they run first
    move_chair();
    furnished->next();
    walk();
    still->next();
  }
  double chair = 1e9, metre = 1e9, nothing = 1e9;
  const auto is_little = [&] { return std::max(chair, metre) <= kMost * nothing; };
  for (int round = 0; round < 9 && (round < 3 || !is_little()); ++round) {
    measure(*furnished, move_chair, chair);
    measure(*still, walk, metre);
    measure(*still, forget, nothing);
  }
  std::printf("chair %.1f ms, a metre %.1f ms, from nothing %.1f ms\n", chair, metre, nothing);
  EXPECT_GT(chair, 0.0);
  EXPECT_GT(metre, 0.0);
  EXPECT_LE(chair, kMost * nothing);
  EXPECT_LE(metre, kMost * nothing);
}

}  // namespace
}  // namespace lightwell
