// The executor on a real device, with validation: any message fails the test.
#include "graph/executor.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>

#include "gpu/acceleration_structure.h"
#include "graph/testing/graph_test.h"
#include "graph/testing/scale.h"
#include "kernels/graph/testing/halve.comp.h"
#include "kernels/graph/testing/probe.comp.h"
#include "kernels/graph/testing/scale.comp.h"
#include "kernels/graph/testing/shared_set.comp.h"
#include "kernels/graph/testing/sum.comp.h"
#include "kernels/graph/testing/triangle.frag.h"
#include "kernels/graph/testing/triangle.vert.h"

namespace lightwell {
namespace {

using ExecutorTest = GraphTest;
using ExecutorTimingTest = GraphTest;

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
TEST_F(ExecutorTimingTest, PassTimesCoverTheWork) {
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
    graph.read_back(values);
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

// Sum over a target's red channel, times 4.
ReadbackTicket sum_red(FrameGraph& graph, ImageHandle target) {
  BufferHandle sum = graph.create_buffer("sum", 1, sizeof(std::uint32_t));
  graph.fill("clear", sum, 0);
  graph.compute("sum", kernels::testing_sum_comp).read("image", target).write("sum", sum).dispatch_threads(64, 64);
  return graph.read_back(sum);
}

TEST_F(ExecutorTest, RasterThenComputeReadsTheTarget) {
  FrameGraph graph(executor().context());
  ImageHandle target = graph.create_image("target", {.width = 64, .height = 64, .format = VK_FORMAT_R8G8B8A8_UNORM});
  ImageHandle depth = graph.create_image("depth", {.width = 64, .height = 64, .format = VK_FORMAT_D32_SFLOAT});
  graph.raster("triangle", kernels::testing_triangle_vert, kernels::testing_triangle_frag, {})
      .color(target, VkClearColorValue{{0, 0, 0, 0}})
      .depth(depth, 1.0f)
      .draw(3);
  const ReadbackTicket ticket = sum_red(graph, target);
  const ReadbackTicket pixels = graph.read_back(target);
  run(graph);
  // Half of the pixels, the diagonal shared by the top-left rule: 64 * 64 / 2 within one diagonal.
  EXPECT_NEAR(fetch<std::uint32_t>(ticket)[0] / 4.0, 64 * 64 / 2, 32);
  const auto rgba = fetch<std::uint8_t>(pixels);
  EXPECT_EQ(rgba[(63 * 64 + 2) * 4], 255);
  EXPECT_EQ(rgba[(2 * 64 + 60) * 4], 0);
}

// The same triangle drawn by count, by arguments from a buffer, and from an index buffer's middle; two draws add up
// where they are blended.
TEST_F(ExecutorTest, DrawsIndirectIndexedAndBlended) {
  const auto draw = [&](Blend blend, const auto& record) {
    FrameGraph graph(executor().context());
    ImageHandle target =
        graph.create_image("target", {.width = 64, .height = 64, .format = VK_FORMAT_R16G16B16A16_SFLOAT});
    RasterPass& pass =
        graph.raster("triangle", kernels::testing_triangle_vert, kernels::testing_triangle_frag, {.blend = blend});
    pass.color(target, VkClearColorValue{});
    record(graph, pass);
    const ReadbackTicket ticket = sum_red(graph, target);
    run(graph);
    return fetch<std::uint32_t>(ticket)[0];
  };
  const std::uint32_t once = draw(Blend::kReplace, [](FrameGraph&, RasterPass& pass) { pass.draw(3); });
  EXPECT_GT(once, 0u);
  const std::vector<std::uint32_t> arguments{7, 7, 3, 1, 0, 0, 0};
  EXPECT_EQ(draw(Blend::kReplace,
                 [&](FrameGraph& graph, RasterPass& pass) {
                   pass.draw_indirect(graph.upload<std::uint32_t>("arguments", arguments), 8);
                 }),
            once);
  const std::vector<std::uint32_t> indices{9, 9, 9, 0, 1, 2};
  EXPECT_EQ(draw(Blend::kReplace,
                 [&](FrameGraph& graph, RasterPass& pass) {
                   pass.index_buffer(graph.upload<std::uint32_t>("indices", indices));
                   pass.draw(DrawCall{.count = 3, .first = 3});
                 }),
            once);
  EXPECT_EQ(draw(Blend::kAdd, [](FrameGraph&, RasterPass& pass) { pass.draw(3).draw(3); }), 2 * once);
}

// A chain of mips, each made of the one before it.
TEST_F(ExecutorTest, MipsAreReadAndWrittenOneByOne) {
  FrameGraph graph(executor().context());
  ImageHandle image =
      graph.create_image("pyramid", {.width = 8, .height = 8, .mips = 4, .format = VK_FORMAT_R32_SFLOAT});
  std::vector<float> texels(64 + 16 + 4 + 1);
  std::iota(texels.begin(), texels.begin() + 64, 0.0f);
  graph.copy("upload", graph.upload<float>("texels", texels), image);
  for (std::uint32_t mip = 1; mip < 4; ++mip)
    graph.compute("halve", kernels::testing_halve_comp)
        .read("finer", image, SamplerKind::kNearestClamp, mip_of(mip - 1))
        .write("coarser", image, mip_of(mip))
        .dispatch_threads(8u >> mip, 8u >> mip);
  const ReadbackTicket ticket = graph.read_back(image, 3);
  run(graph);
  EXPECT_EQ(fetch<float>(ticket)[0], 31.5f);
}

// One set for two kernels, its buffer in one page and in four; what they write is in one page and in three.
TEST_F(ExecutorTest, SharedSetsAreBoundWithTheirConstantsAndPages) {
  std::vector<std::uint32_t> numbers(1000);
  std::iota(numbers.begin(), numbers.end(), 0u);
  const std::uint64_t range = executor().context().descriptor_range;
  for (const std::uint64_t reached : {range, std::uint64_t{1024}}) {
    executor().context().descriptor_range = reached;
    FrameGraph graph(executor().context());
    const BufferHandle uploaded = graph.upload<std::uint32_t>("numbers", numbers);
    const SetHandle set = graph.create_set({.name = "numbers",
                                            .number = 1,
                                            .members = {{.binding = "numbers", .buffer = uploaded}},
                                            .constants = {{"kOffset", 5}, {"kOfAnotherKernel", 1}}});
    std::vector<ReadbackTicket> tickets;
    for (const std::uint32_t factor : {1u, 2u}) {
      BufferHandle target = graph.create_buffer("target", 600, sizeof(std::uint32_t));
      graph.compute("scale", kernels::testing_shared_set_comp)
          .bind(set)
          .write("target", target)
          .push(glsl::ScaleParams{600, factor})
          .dispatch_threads(600);
      tickets.push_back(graph.read_back(target));
    }
    run(graph);
    for (std::uint32_t i = 0; i < 600; ++i) {
      ASSERT_EQ(fetch<std::uint32_t>(tickets[0])[i], i + 5 + 400);
      ASSERT_EQ(fetch<std::uint32_t>(tickets[1])[i], 2 * i + 5 + 400);
    }
  }
  executor().context().descriptor_range = range;
}

// Four pages of 256 words are the most, and one for a block that is no array.
TEST_F(ExecutorTest, BuffersBeyondTheirPagesAreInputErrors) {
  const std::uint64_t range = executor().context().descriptor_range;
  executor().context().descriptor_range = 1024;
  {
    FrameGraph graph(executor().context());
    BufferHandle target = graph.create_buffer("many numbers", 1025, sizeof(std::uint32_t));
    EXPECT_THROW(graph.compute("scale", kernels::testing_shared_set_comp).write("target", target), InputError);
    BufferHandle plain = graph.create_buffer("numbers", 257, sizeof(std::uint32_t));
    EXPECT_THROW(graph.compute("scale", kernels::testing_scale_comp).write("target", plain), InputError);
  }
  executor().context().descriptor_range = range;
}

// What a frame that was dropped would have written is written by the next one.
TEST_F(ExecutorTest, WatchersAreToldWhenTheirFrameIsComplete) {
  std::vector<std::uint32_t> told;
  const auto declare = [&](FrameGraph& graph, std::uint32_t value) {
    const std::vector<std::uint32_t> words{value};
    graph.watch(graph.upload<std::uint32_t>("watched", words), [&told](std::span<const std::byte> bytes) {
      told.resize(told.size() + 1);
      std::memcpy(&told.back(), bytes.data(), sizeof(std::uint32_t));
    });
  };
  {
    FrameGraph graph(executor().context());
    declare(graph, 7);
    run(graph);
  }
  EXPECT_TRUE(told.empty());
  {
    FrameGraph dropped(executor().context());
    declare(dropped, 8);
  }
  {
    FrameGraph graph(executor().context());
    declare(graph, 9);
    run(graph);  // says that the first frame is complete
  }
  EXPECT_EQ(told, (std::vector<std::uint32_t>{7}));
  executor().notice_completed(frame_);
  executor().notice_completed(frame_);
  EXPECT_EQ(told, (std::vector<std::uint32_t>{7, 9}));
}

TEST_F(ExecutorTest, ADroppedFrameLeavesNothingBehind) {
  bool fresh = false;
  const auto declare = [&](FrameGraph& graph) {
    BufferHandle history = graph.history_buffer("counter", 4, sizeof(std::uint32_t), fresh);
    if (fresh) graph.fill("clear", history, 5);
    return graph.read_back(history);
  };
  {
    FrameGraph dropped(executor().context());
    declare(dropped);
  }
  for (int frame = 0; frame < 2; ++frame) {
    FrameGraph graph(executor().context());
    const ReadbackTicket ticket = declare(graph);
    EXPECT_EQ(fresh, frame == 0);
    run(graph);
    EXPECT_EQ(fetch<std::uint32_t>(ticket)[0], 5u);
  }
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
