// Measures what it costs when one instance of a scene begins to move and when it is static again; not part of the run:
//   lightwell_passes_test --gtest_also_run_disabled_tests --gtest_filter='*RestBench.*'
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "passes/gpu_scene/scene_motion.h"
#include "passes/trace/testing/trace_test_base.h"

namespace lightwell {
namespace {

class DISABLED_RestBench : public TraceTest {
 protected:
  struct Cost {
    double gpu_ms = 0.0;   // of all passes
    double wall_ms = 0.0;  // declared, recorded, submitted and waited for
  };

  // One frame of scene and hierarchy.
  Cost show(Traced& traced, const SceneSnapshot& snapshot) {
    const auto start = std::chrono::steady_clock::now();
    FrameGraph graph(executor().context());
    traced.tracer.record(graph, traced.gpu_scene.record(graph, snapshot));
    run(graph);
    Cost cost;
    cost.wall_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    for (const PassTime& pass : executor().pass_times(frame_)) cost.gpu_ms += pass.time_ms;
    return cost;
  }

  // Medians of frames in which nothing moves; the body begins to move; it moves on; it is static again.
  void measure(const std::string& name, Scene scene);
};

// A triangle beside everything else, the scene's last instance.
void add_body(Scene& scene) {
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  primitive.normals.assign(3, {0, 0, 1});
  primitive.indices = {0, 1, 2};
  Node node;
  node.mesh = static_cast<int>(scene.meshes.size());
  scene.meshes.push_back({"body", {primitive}, {}});
  scene.nodes.push_back(node);
}

void DISABLED_RestBench::measure(const std::string& name, Scene scene) {
  constexpr int kRounds = 7;
  const std::array<const char*, 4> kinds{"still", "begins to move", "moves on", "static again"};
  add_body(scene);
  SceneSnapshot snapshot = take_snapshot(scene);
  Traced traced(scene, snapshot);
  const auto move = [&] { snapshot.instances.back().to_world[3].x += 0.1f; };
  std::array<std::vector<Cost>, 4> costs;
  for (int i = 0; i < 3; ++i) show(traced, snapshot);
  for (int round = 0; round <= kRounds; ++round) {
    costs[0].push_back(show(traced, snapshot));
    move();
    costs[1].push_back(show(traced, snapshot));
    move();
    costs[2].push_back(show(traced, snapshot));
    for (std::uint32_t i = 0; i < kStillFramesUntilStatic; ++i) show(traced, snapshot);
    costs[3].push_back(show(traced, snapshot));
  }
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    std::vector<double> gpu, wall;
    for (auto cost = costs[kind].begin() + 1; cost != costs[kind].end();
         ++cost) {  // drivers compile in the first round
      gpu.push_back(cost->gpu_ms);
      wall.push_back(cost->wall_ms);
    }
    std::nth_element(gpu.begin(), gpu.begin() + kRounds / 2, gpu.end());
    std::nth_element(wall.begin(), wall.begin() + kRounds / 2, wall.end());
    std::printf("%-16s %-16s %10.2f ms on the device %10.2f ms in all\n", name.c_str(), kinds[kind], gpu[kRounds / 2],
                wall[kRounds / 2]);
  }
}

TEST_F(DISABLED_RestBench, OneBodyInScenes) {
  measure("room", load_scene(LIGHTWELL_SOURCE_DIR "/scenes/room.gltf"));
  const std::string sponza = LIGHTWELL_SHARED_DIR "/scenes/sponza-crytek/sponza-crytek.gltf";
  if (std::filesystem::exists(sponza)) measure("sponza-crytek", load_scene(sponza, {.scale = 0.01f}));
}

}  // namespace
}  // namespace lightwell
