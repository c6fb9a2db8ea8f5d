// Measures the published propagation and prints tables; not part of the test run:
//   lightwell_techniques_test --gtest_also_run_disabled_tests --gtest_filter='*PaperBench.*'
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "techniques/light_volume/paper_test_sh.h"
#include "techniques/light_volume/paper_test_volume.h"

namespace lightwell {
namespace {

ShaderSh sh;

class DISABLED_PaperBench : public PaperVolumeTest {
 protected:
  struct Cost {
    double gpu_ms = 0.0;
    double processor_ms =
        0.0;  // of all threads of this program: what a software device needs, however busy the machine
  };

  // Of all steps of one frame.
  Cost propagation_cost(const TestVolume& volume, std::uint32_t steps) {
    FrameGraph graph(executor().context());
    PaperVolume handles = upload(graph, volume);
    record_paper_propagation(graph, volume.grid, handles, {.steps = steps});
    Cost cost;
    const std::clock_t start = std::clock();
    run(graph);
    cost.processor_ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    for (const PassTime& pass : executor().pass_times(frame_)) {
      if (pass.name == "propagate") cost.gpu_ms = pass.time_ms;
    }
    return cost;
  }
};

// A box whose floor sends radiance 1/pi (1 W/m^2), on black walls.
TestVolume lit_floor(std::uint32_t resolution) {
  TestVolume volume(resolution);
  volume.close();
  const int last = static_cast<int>(resolution) - 1;
  volume.for_each_cell([&](glm::ivec3 c, std::size_t i) {
    if (c.y != 0 || c.x == 0 || c.z == 0 || c.x == last || c.z == last) return;
    volume.set_light(i, sh.sh_hemisphere({0.0f, 1.0f, 0.0f}) / sh.kPi);
  });
  return volume;
}

// The source reports one time per voxel and step for all scenes and grids. Here from the difference of two runs, so
// that what a frame costs besides its steps does not count.
TEST_F(DISABLED_PaperBench, TimePerVoxelAndStep) {
  constexpr std::uint32_t kSteps = 16;
  std::printf("%10s %16s %34s\n", "cells", "GPU ns", "processor ns / (voxel step)");
  for (const std::uint32_t resolution : {32u, 64u, 128u}) {
    const TestVolume volume = lit_floor(resolution);
    propagation_cost(volume, 1);  // drivers compile at the first dispatch
    Cost least{1e30, 1e30};
    for (int repeat = 0; repeat < 5; ++repeat) {
      const Cost few = propagation_cost(volume, kSteps);
      const Cost many = propagation_cost(volume, 3 * kSteps);
      least.gpu_ms = std::min(least.gpu_ms, many.gpu_ms - few.gpu_ms);
      least.processor_ms = std::min(least.processor_ms, many.processor_ms - few.processor_ms);
    }
    const double to_ns = 1e6 / (2.0 * kSteps * volume.grid.cell_count);
    std::printf("%8u^3 %16.1f %34.1f\n", resolution, to_ns * least.gpu_ms, to_ns * least.processor_ms);
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
