#include "passes/environment/gpu_environment.h"

#include <vector>

#include "graph/testing/graph_test.h"
#include "passes/environment/environment_table.h"

namespace lightwell {
namespace {

using GpuEnvironmentTest = GraphTest;

Environment make_map() {
  Environment environment;
  environment.radiance = {1.0f, 2.0f, 0.5f};
  environment.map = Image(8, 4, 3);
  for (std::size_t i = 0; i < environment.map.pixels.size(); ++i)
    environment.map.pixels[i] = 0.25f * static_cast<float>(i);
  return environment;
}

// Radiance of all texels.
std::vector<glm::vec4> expected_texels(const Environment& environment) {
  std::vector<glm::vec4> texels;
  for (std::size_t i = 0; i < environment.map.pixels.size(); i += 3) {
    const float* rgb = &environment.map.pixels[i];
    texels.emplace_back(environment.radiance * glm::vec3(rgb[0], rgb[1], rgb[2]), 1.0f);
  }
  return texels;
}

// Frames that are refused change nothing: the next one still fills texels and table. Later ones keep both.
TEST_F(GpuEnvironmentTest, TheFirstRecordedFrameFillsIt) {
  const Environment environment = make_map();
  GpuEnvironment gpu_environment(device(), environment);
  for (int refused = 0; refused < 2; ++refused) {
    FrameGraph graph(executor().context());
    gpu_environment.record(graph);
    gpu_environment.record_table(graph);
  }
  for (int frame = 0; frame < 3; ++frame) {
    FrameGraph graph(executor().context());
    const ImageHandle image = gpu_environment.record(graph);
    const BufferHandle table = gpu_environment.record_table(graph);
    EXPECT_EQ(graph.passes().size(), frame == 0 ? 2u : 0u);
    const ReadbackTicket texels = graph.read_back(image);
    const ReadbackTicket sums = graph.read_back(table);
    run(graph);
    EXPECT_EQ(fetch<glm::vec4>(texels), expected_texels(environment));
    EXPECT_EQ(fetch<float>(sums), make_environment_table(environment).cumulative);
  }
}

TEST_F(GpuEnvironmentTest, AConstantOneIsOneTexel) {
  GpuEnvironment gpu_environment(device(), {{0.5f, 1.0f, 2.0f}, {}});
  FrameGraph graph(executor().context());
  const ReadbackTicket texels = graph.read_back(gpu_environment.record(graph));
  run(graph);
  EXPECT_EQ(fetch<glm::vec4>(texels), (std::vector<glm::vec4>{{0.5f, 1.0f, 2.0f, 1.0f}}));
}

}  // namespace
}  // namespace lightwell
