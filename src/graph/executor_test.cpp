// The executor on a real device, with validation: any message fails the test.
#include "graph/executor.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>

#include "gpu/acceleration_structure.h"
#include "graph/testing/graph_test.h"
#include "graph/testing/scale.h"
#include "kernels/graph/testing/probe.comp.h"
#include "kernels/graph/testing/scale.comp.h"
#include "kernels/graph/testing/sum.comp.h"
#include "kernels/graph/testing/triangle.frag.h"
#include "kernels/graph/testing/triangle.vert.h"

namespace lightwell {
namespace {

using ExecutorTest = GraphTest;

TEST_F(ExecutorTest, ComputeChainsThroughPooledBuffers) {
  std::vector<std::uint32_t> input(1000);
  std::iota(input.begin(), input.end(), 0u);
  for (int frame = 0; frame < 3; ++frame) {
    FrameGraph graph(executor().context());
    BufferHandle values = graph.upload("input", std::span<const std::uint32_t>(input));
    for (int i = 0; i < 4; ++i) {
      BufferHandle next = graph.create_buffer("step", input.size(), sizeof(std::uint32_t));
      graph.compute("scale", kernels::testing_scale_comp)
          .read("source", values)
          .write("target", next)
          .constant("kOffset", 1)
          .push(glsl::ScaleParams{static_cast<std::uint32_t>(input.size()), 2})
          .dispatch_threads(static_cast<std::uint32_t>(input.size()));
      values = next;
    }
    const ReadbackTicket ticket = graph.read_back(values);
    run(graph);
    const auto result = fetch<std::uint32_t>(ticket);
    for (std::uint32_t i = 0; i < input.size(); ++i) ASSERT_EQ(result[i], 16 * i + 15);
  }
  const std::vector<PassTime> times = executor().pass_times(frame_);
  ASSERT_FALSE(times.empty());
  EXPECT_EQ(times[0].name, "scale");
  EXPECT_EQ(times[0].count, 4u);
  // Four steps, lives of two at a time: two physical buffers.
  EXPECT_EQ(device().memory().report().at("step").count, 2u);
}

// Drivers may put time stamps off; the passes' times must still be those of their work.
TEST_F(ExecutorTest, PassTimesCoverTheWork) {
  const std::vector<std::uint32_t> input(1 << 21);
  double wall_ms = 0.0;
  for (int frame = 0; frame < 2; ++frame) {  // drivers compile in the first
    FrameGraph graph(executor().context());
    BufferHandle values = graph.upload("input", std::span<const std::uint32_t>(input));
    for (int i = 0; i < 16; ++i) {
      BufferHandle next = graph.create_buffer("step", input.size(), sizeof(std::uint32_t));
      graph.compute("scale", kernels::testing_scale_comp)
          .read("source", values)
          .write("target", next)
          .constant("kOffset", 1)
          .push(glsl::ScaleParams{static_cast<std::uint32_t>(input.size()), 2})
          .dispatch_threads(static_cast<std::uint32_t>(input.size()));
      values = next;
    }
    const auto start = std::chrono::steady_clock::now();
    run(graph);
    wall_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }
  double pass_ms = 0.0;
  for (const PassTime& time : executor().pass_times(frame_)) pass_ms += time.time_ms;
  EXPECT_LE(pass_ms, wall_ms);
  // The rest is the submission and copying the input on the host.
  EXPECT_GE(pass_ms, 0.25 * wall_ms);
}

TEST_F(ExecutorTest, HistorySurvivesAndIsFreshOnce) {
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    FrameGraph graph(executor().context());
    bool fresh = false;
    BufferHandle history = graph.history_buffer("counter", 4, sizeof(std::uint32_t), fresh);
    EXPECT_EQ(fresh, frame == 0);
    if (fresh) graph.fill("clear", history, 5);
    BufferHandle copy = graph.create_buffer("copy", 4, sizeof(std::uint32_t));
    graph.copy("keep", history, copy, 16);
    graph.compute("triple", kernels::testing_scale_comp)
        .read("source", copy)
        .write("target", history)
        .push(glsl::ScaleParams{4, 3})
        .dispatch(1);
    const ReadbackTicket ticket = graph.read_back(history);
    run(graph);
    EXPECT_EQ(fetch<std::uint32_t>(ticket)[3], frame == 0 ? 15u : frame == 1 ? 45u : 135u);
  }
}

TEST_F(ExecutorTest, RasterThenComputeReadsTheTarget) {
  FrameGraph graph(executor().context());
  ImageHandle target = graph.create_image("target", {.width = 64, .height = 64, .format = VK_FORMAT_R8G8B8A8_UNORM});
  ImageHandle depth = graph.create_image("depth", {.width = 64, .height = 64, .format = VK_FORMAT_D32_SFLOAT});
  graph.raster("triangle", kernels::testing_triangle_vert, kernels::testing_triangle_frag, {})
      .color(target, VkClearColorValue{{0, 0, 0, 0}})
      .depth(depth, 1.0f)
      .draw(3);
  BufferHandle sum = graph.create_buffer("sum", 1, sizeof(std::uint32_t));
  graph.fill("clear", sum, 0);
  graph.compute("sum", kernels::testing_sum_comp).read("image", target).write("sum", sum).dispatch_threads(64, 64);
  const ReadbackTicket ticket = graph.read_back(sum);
  const ReadbackTicket pixels = graph.read_back(target);
  run(graph);
  // Half of the pixels, the diagonal shared by the top-left rule: 64 * 64 / 2 within one diagonal.
  EXPECT_NEAR(fetch<std::uint32_t>(ticket)[0] / 4.0, 64 * 64 / 2, 32);
  const auto rgba = fetch<std::uint8_t>(pixels);
  EXPECT_EQ(rgba[(63 * 64 + 2) * 4], 255);
  EXPECT_EQ(rgba[(2 * 64 + 60) * 4], 0);
}

// Built, then moved with the last build's tree, then kept: each frame's rays meet the triangle where it is.
TEST_F(ExecutorTest, AccelerationStructuresAreBuiltUpdatedAndKept) {
  if (!device().has_ray_query()) GTEST_SKIP() << device().summary().name << " has no ray queries";
  {
    AccelerationStructure bottom(device(), "test: bottom", {{1, true}}, true);
    AccelerationStructure top(device(), "test: top", 1);
    const float depths[] = {3.0f, 5.0f, 5.0f};
    for (std::size_t frame = 0; frame < 3; ++frame) {
      FrameGraph graph(executor().context());
      AccelerationStructureHandle scene = graph.import_acceleration_structure(top);
      if (frame < 2) {
        const float z = depths[frame];
        const std::vector<float> corners{-1, -1, z, 1, -1, z, 0, 1, z};
        AccelerationStructureHandle triangle = graph.import_acceleration_structure(bottom);
        graph.build("build triangle", triangle, graph.upload<float>("corners", corners), frame == 1);
        graph.build("build scene", scene, {&triangle, 1});
      }
      BufferHandle depth = graph.create_buffer("depth", 1, sizeof(float));
      graph.compute("probe", kernels::testing_probe_comp).read("structure", scene).write("depth", depth).dispatch(1);
      const ReadbackTicket ticket = graph.read_back(depth);
      run(graph);
      EXPECT_FLOAT_EQ(fetch<float>(ticket)[0], depths[frame]) << "frame " << frame;
    }
    EXPECT_GT(device().memory().report().at("test: bottom").bytes, kTriangleBytes);
  }
  FrameGraph graph(executor().context());
  run(graph);
  EXPECT_EQ(device().memory().report().at("test: bottom").bytes, 0u) << "given back with the frame that used it last";
}

}  // namespace
}  // namespace lightwell
