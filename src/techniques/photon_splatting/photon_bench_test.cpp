// Times of the world part; run by hand: lightwell_techniques_test --gtest_also_run_disabled_tests
// --gtest_filter='*PhotonBench*'
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "graph/testing/device_test.h"
#include "scene/builtin.h"
#include "techniques/photon_splatting/photon_test_frames.h"

namespace lightwell {
namespace {

class PhotonBench : public DeviceTest {};

void print_frame(const std::string& name, PhotonFrames& frames) {
  frames.next();
  std::map<std::string, double> times;
  PhotonFrame frame;
  constexpr int kFrames = 3;
  for (int i = 0; i < kFrames; ++i) {
    frame = frames.next();
    for (const auto& [pass, time_ms] : frame.times_ms) times[pass] += time_ms / kFrames;
  }
  double light = 0.0, kept = 0.0, width = 0.0, accepted = 0.0;
  std::size_t lit = 0;
  for (const glsl::LightPoint& point : frame.points) light += point.flux.g;
  for (const glsl::Splat& splat : frame.splats) {
    kept += splat.flux.g;
    if (splat.flux == glm::vec3(0.0f)) continue;
    ++lit;
    width += 2.0 * splat.half_width;
    accepted += splat.accepted;
  }
  std::cout << name << ": " << frame.splats.size() << " splats, " << lit << " with flux, " << kept / light
            << " of the light; mean width " << width / lit << " m, accepted " << accepted / lit << "; ms:";
  for (const auto& [pass, time_ms] : times) std::cout << " " << pass << " " << std::round(10.0 * time_ms) / 10.0 << ";";
  std::cout << "\n";
}

TEST_F(PhotonBench, DISABLED_Cost) {
  const std::string sponza = LIGHTWELL_SHARED_DIR "/scenes/sponza-crytek/sponza-crytek.gltf";
  std::vector<std::pair<std::string, Scene>> scenes{{"cornell-spot", load_scene(resolve_scene("cornell-spot"))}};
  if (std::filesystem::exists(sponza)) scenes.emplace_back("sponza-crytek", load_scene(sponza, {.scale = 0.01f}));
  for (const auto& [name, scene] : scenes) {
    std::vector<WorldLight> lights = take_snapshot(scene).lights;
    if (name == "sponza-crytek") lights = {make_spot_light({-8, 8, 0}, {1, -1, 0.1f}, 20, 45, {500, 500, 500})};
    for (const PhotonOptions& options :
         {PhotonOptions{}, PhotonOptions{.receiver_test = false}, PhotonOptions{.map_size = 1},
          PhotonOptions{.photons = 25000, .bounces = 1, .receiver_test = false},
          PhotonOptions{.photons = 25000, .bounces = 1, .stratify = 5, .receiver_test = false}}) {
      PhotonFrames frames(device(), scene, lights, options);
      print_frame(name, frames);
    }
  }
}

}  // namespace
}  // namespace lightwell
