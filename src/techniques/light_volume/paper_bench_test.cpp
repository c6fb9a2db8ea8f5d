// Measures the published propagation and prints tables; not part of the test run:
//   lightwell_techniques_test --gtest_also_run_disabled_tests --gtest_filter='*PaperBench.*'
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "techniques/light_volume/paper_test_sh.h"
#include "techniques/light_volume/paper_test_volume.h"

namespace lightwell {
namespace {

ShaderSh sh;

class DISABLED_PaperBench : public PaperVolumeTest {
 protected:
  // GPU time of all steps of one frame, in ms.
  double propagation_time(const TestVolume& volume, std::uint32_t steps) {
    FrameGraph graph(executor_.context());
    PaperVolume handles = upload(graph, volume);
    record_paper_propagation(graph, volume.grid, handles, {.steps = steps});
    run(graph);
    for (const PassTime& pass : executor_.pass_times(frame_)) {
      if (pass.name == "propagate") return pass.time_ms;
    }
    return 0.0;
  }
};

// A box whose floor sends radiance 1/pi (1 W/m^2), on black walls.
TestVolume lit_floor(std::uint32_t resolution) {
  TestVolume volume(resolution);
  volume.close();
  const int last = static_cast<int>(resolution) - 1;
  volume.for_each_cell([&](glm::ivec3 c, std::size_t i) {
    if (c.y != 0 || c.x == 0 || c.z == 0 || c.x == last || c.z == last) return;
    volume.set_light(i, sh.sh_hemisphere({0.0f, 1.0f, 0.0f}) / sh.kShPi);
  });
  return volume;
}

TEST_F(DISABLED_PaperBench, TimePerVoxelAndStep) {
  std::printf("%10s %6s %12s %22s\n", "cells", "steps", "time (ms)", "ns / (voxel step)");
  for (const std::uint32_t resolution : {32u, 64u, 128u}) {
    const TestVolume volume = lit_floor(resolution);
    constexpr std::uint32_t kSteps = 16;
    propagation_time(volume, 1);  // drivers compile at the first dispatch
    double best = 1e30;
    for (int repeat = 0; repeat < 3; ++repeat) best = std::min(best, propagation_time(volume, kSteps));
    const double voxel_steps = double{kSteps} * volume.grid.cell_count;
    std::printf("%8u^3 %6u %12.2f %22.1f\n", resolution, kSteps, best, best * 1e6 / voxel_steps);
  }
}

// The mean irradiance on the inside of a wall, edges left out. Walls lie in mid-cell: light propagation volumes, which
// look half a cell in front of a surface, see the mean of the wall's cell and the next.
double mean_irradiance(const TestVolume& volume, const std::vector<float>& received, glm::vec3 normal, bool occlusion) {
  double sum = 0.0;
  int count = 0;
  volume.for_each_cell([&](glm::ivec3 c, std::size_t i) {
    if (volume.cells[i] != glm::vec4(normal, 1.0f)) return;
    glm::vec4 light = volume.coefficients(received, i);
    if (!occlusion) {
      light = 0.5f * (light + volume.coefficients(received, volume.index(c + glm::ivec3(normal))));
    }
    sum += double{glm::dot(light, sh.sh_cosine_lobe(-normal))};
    ++count;
  });
  return sum / count;
}

// Where the light of the floor arrives, beside the exact exchange between faces of a cube (0.2 each, 0 on itself).
TEST_F(DISABLED_PaperBench, FalseScattering) {
  std::printf("%10s %12s %10s %10s %10s\n", "cells", "", "ceiling", "side", "floor");
  std::printf("%10s %12s %10.3f %10.3f %10.3f\n", "", "truth", 0.2, 0.2, 0.0);
  for (const bool occlusion : {true, false}) {
    for (const std::uint32_t resolution : {16u, 32u, 64u}) {
      TestVolume volume = lit_floor(resolution);
      const std::uint32_t steps = resolution * resolution / 2;  // spreads like diffusion
      const std::vector<float> received =
          propagate(volume, {.steps = steps, .reflectance = 0.0f, .occlusion = occlusion});
      std::printf("%8u^3 %12s %10.4f %10.4f %10.4f\n", resolution, occlusion ? "paper" : "paper-lpv",
                  mean_irradiance(volume, received, {0.0f, -1.0f, 0.0f}, occlusion),
                  mean_irradiance(volume, received, {1.0f, 0.0f, 0.0f}, occlusion),
                  mean_irradiance(volume, received, {0.0f, 1.0f, 0.0f}, occlusion));
    }
  }
}

}  // namespace
}  // namespace lightwell
