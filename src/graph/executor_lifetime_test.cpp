// What lives how long while frames are in flight, on a real device.
#include <gtest/gtest.h>

#include "gpu/acceleration_structure.h"
#include "gpu/submit.h"
#include "graph/executor.h"
#include "graph/testing/graph_test.h"
#include "kernels/graph/testing/probe.comp.h"

namespace lightwell {
namespace {

class ExecutorLifetimeTest : public GraphTest {
 protected:
  static std::uint64_t held() { return device().memory().report()["test: mine"].bytes; }
};

// Each executor counts its own frames: how far another has come says nothing.
TEST_F(ExecutorLifetimeTest, MemoryWaitsForTheFramesOfItsOwnExecutor) {
  Submitter submitter(device());
  const auto record = [&](GraphExecutor& who, Buffer* buffer, std::uint64_t completed) {
    FrameGraph graph(who.context());
    BufferHandle handle = buffer ? graph.import_buffer(*buffer) : graph.create_buffer("test: other", 4, 4);
    graph.fill("fill", handle, 1);
    submitter.run([&](VkCommandBuffer commands) { who.record(graph, commands, completed); });
  };
  GraphExecutor old(device());
  for (std::uint64_t frame = 1; frame <= 50; ++frame) record(old, nullptr, frame - 1);

  auto young = std::make_unique<GraphExecutor>(device());
  auto buffer = std::make_unique<Buffer>(device(), "test: mine", 1000, MemoryKind::kDevice);
  record(*young, buffer.get(), 0);
  buffer.reset();
  record(old, nullptr, 50);
  EXPECT_GT(held(), 0u) << "nobody said that the first frame is done";
  record(*young, nullptr, 1);
  EXPECT_EQ(held(), 0u);

  // The other way round: what the older one leaves behind goes with it, not 50 frames of the younger one later.
  buffer = std::make_unique<Buffer>(device(), "test: mine", 1000, MemoryKind::kDevice);
  {
    GraphExecutor closing(device());
    for (std::uint64_t frame = 1; frame <= 50; ++frame) record(closing, buffer.get(), frame - 1);
    buffer.reset();
    EXPECT_GT(held(), 0u);
  }
  EXPECT_EQ(held(), 0u);
}

// A frame may reach what it imports by address, where no pass names it.
TEST_F(ExecutorLifetimeTest, WhatAFrameImportsLivesUntilItIsDone) {
  Submitter submitter(device());
  GraphExecutor executor(device());
  const auto record = [&](Buffer* buffer, std::uint64_t completed) {
    FrameGraph graph(executor.context());
    if (buffer) graph.import_buffer(*buffer);
    submitter.run([&](VkCommandBuffer commands) { executor.record(graph, commands, completed); });
  };
  auto buffer = std::make_unique<Buffer>(device(), "test: mine", 1000, MemoryKind::kDevice);
  record(buffer.get(), 0);
  buffer.reset();
  record(nullptr, 0);
  EXPECT_GT(held(), 0u);
  record(nullptr, 1);
  EXPECT_EQ(held(), 0u);
}

// The second frame builds nothing: its rays walk a tree that a top level names by address.
TEST_F(ExecutorLifetimeTest, BottomLevelsLiveAsLongAsFramesImportThem) {
  if (!device().has_ray_query()) GTEST_SKIP() << device().summary().name << " has no ray queries";
  Submitter submitter(device());
  GraphExecutor executor(device());
  AccelerationStructure top(device(), "test: top", 1);
  auto bottom =
      std::make_unique<AccelerationStructure>(device(), "test: mine", std::vector<TriangleRange>{{1, true}}, false);
  for (std::uint64_t frame = 1; frame <= 4; ++frame) {
    FrameGraph graph(executor.context());
    if (bottom) {
      AccelerationStructureHandle scene = graph.import_acceleration_structure(top);
      AccelerationStructureHandle triangle = graph.import_acceleration_structure(*bottom);
      if (frame == 1) {
        const float corners[] = {-1, -1, 3, 1, -1, 3, 0, 1, 3};
        graph.build("build triangle", triangle, graph.upload<float>("corners", corners), false);
        graph.build("build scene", scene, {&triangle, 1});
      }
      BufferHandle depth = graph.create_buffer("depth", 1, sizeof(float));
      graph.compute("probe", kernels::testing_probe_comp).read("structure", scene).write("depth", depth).dispatch(1);
      graph.read_back(depth);
    }
    // Before frame 3 the first is done, before frame 4 the second.
    submitter.run([&](VkCommandBuffer commands) { executor.record(graph, commands, frame < 3 ? 0 : frame - 2); });
    if (frame == 2) bottom.reset();
    EXPECT_EQ(held() > 0, frame <= 3) << "frame " << frame;
  }
}

}  // namespace
}  // namespace lightwell
