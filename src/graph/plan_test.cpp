// The frame graph without a device: barriers, memory sharing, and misuse that stops at once.
#include "graph/plan.h"

#include <gtest/gtest.h>

#include <random>

#include "gpu/acceleration_structure.h"
#include "graph/testing/scale.h"
#include "kernels/graph/testing/probe.comp.h"
#include "kernels/graph/testing/scale.comp.h"
#include "kernels/graph/testing/triangle.frag.h"
#include "kernels/graph/testing/triangle.vert.h"

namespace lightwell {
namespace {

constexpr ResourceUse buffer_use(UseKind kind, VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT) {
  return {false, 0, kind, stages};
}

BufferHandle scale(FrameGraph& graph, BufferHandle source, std::uint64_t count) {
  BufferHandle target = graph.create_buffer("scaled", count, 4);
  graph.compute("scale", kernels::testing_scale_comp)
      .read("source", source)
      .write("target", target)
      .push(glsl::ScaleParams{static_cast<std::uint32_t>(count), 2})
      .dispatch_threads(static_cast<std::uint32_t>(count));
  return target;
}

TEST(Barriers, ReadAfterWriteWaitsOnceForEachStage) {
  ResourceState state;
  Barrier barrier;
  EXPECT_FALSE(advance(state, describe_use(buffer_use(UseKind::kStorageWrite)), false, barrier));
  EXPECT_TRUE(advance(state, describe_use(buffer_use(UseKind::kStorageRead)), false, barrier));
  EXPECT_EQ(barrier.from_stages, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
  EXPECT_TRUE(barrier.from_access & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
  EXPECT_EQ(barrier.to_access, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
  EXPECT_FALSE(advance(state, describe_use(buffer_use(UseKind::kStorageRead)), false, barrier));
  const auto in_fragment = buffer_use(UseKind::kStorageRead, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
  EXPECT_TRUE(advance(state, describe_use(in_fragment), false, barrier));
  EXPECT_FALSE(advance(state, describe_use(in_fragment), false, barrier));
}

TEST(Barriers, WriteAfterReadsWaitsForAllOfThem) {
  ResourceState state;
  Barrier barrier;
  advance(state, describe_use(buffer_use(UseKind::kTransferWrite, 0)), false, barrier);
  advance(state, describe_use(buffer_use(UseKind::kStorageRead)), false, barrier);
  advance(state, describe_use(buffer_use(UseKind::kIndirectRead, 0)), false, barrier);
  EXPECT_TRUE(advance(state, describe_use(buffer_use(UseKind::kStorageWrite)), false, barrier));
  EXPECT_TRUE(barrier.from_stages & VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
  EXPECT_TRUE(barrier.from_stages & VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT);
  EXPECT_TRUE(barrier.from_stages & VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
}

TEST(Barriers, ImagesChangeLayoutEvenBetweenReads) {
  ResourceState state;
  Barrier barrier;
  const auto use = [](UseKind kind) { return describe_use({true, 0, kind, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT}); };
  EXPECT_TRUE(advance(state, use(UseKind::kStorageWrite), true, barrier));
  EXPECT_EQ(barrier.from_layout, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_EQ(barrier.to_layout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_TRUE(advance(state, use(UseKind::kSampled), true, barrier));
  EXPECT_TRUE(advance(state, use(UseKind::kTransferRead), true, barrier));
  EXPECT_TRUE(barrier.from_stages & VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
  EXPECT_EQ(barrier.to_layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
}

TEST(Barriers, BuildsWaitForTheirInputAndRaysForBuilds) {
  const VkPipelineStageFlags2 build = VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR;
  Barrier barrier;
  ResourceState corners;
  advance(corners, describe_use(buffer_use(UseKind::kStorageWrite)), false, barrier);
  EXPECT_TRUE(advance(corners, describe_use(buffer_use(UseKind::kBuildInput, 0)), false, barrier));
  EXPECT_EQ(barrier.to_stages, build);
  EXPECT_EQ(barrier.to_access, VK_ACCESS_2_SHADER_READ_BIT);

  ResourceState structure;
  EXPECT_FALSE(advance(structure, describe_use(buffer_use(UseKind::kAccelerationStructureBuild, 0)), false, barrier));
  EXPECT_TRUE(advance(structure, describe_use(buffer_use(UseKind::kAccelerationStructureRead, build)), false, barrier));
  EXPECT_TRUE(advance(structure, describe_use(buffer_use(UseKind::kAccelerationStructureRead)), false, barrier));
  EXPECT_EQ(barrier.from_stages, build);
  EXPECT_EQ(barrier.from_access & VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR,
            VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR);
  EXPECT_EQ(barrier.to_access, VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR);
  EXPECT_TRUE(advance(structure, describe_use(buffer_use(UseKind::kAccelerationStructureBuild, 0)), false, barrier));
  EXPECT_TRUE(barrier.from_stages & VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
}

// Replays random uses against the definition: a use must be ordered after every earlier conflicting use, directly or
// through barriers before it.
TEST(Barriers, RandomSequencesNeverLeaveAHazard) {
  constexpr unsigned kSeed = 7;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  const VkPipelineStageFlags2 stages[] = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
                                          VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT};
  for (int round = 0; round < 2000; ++round) {
    ResourceState state;
    VkPipelineStageFlags2 unsafe_after_write = 0;  // stages that have not seen the last write
    VkPipelineStageFlags2 reads_open = 0;          // reads that no barrier has closed since
    bool written = false;
    for (int step = 0; step < 12; ++step) {
      const bool write = random() % 3 == 0;
      const VkPipelineStageFlags2 stage = stages[random() % 3];
      Barrier barrier;
      const bool has =
          advance(state, describe_use(buffer_use(write ? UseKind::kStorageWrite : UseKind::kStorageRead, stage)), false,
                  barrier);
      if (has) {
        if (barrier.from_access & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT) unsafe_after_write &= ~barrier.to_stages;
        reads_open &= ~barrier.from_stages;
      }
      ASSERT_FALSE(written && (unsafe_after_write & stage) != 0) << "round " << round << " step " << step;
      if (write) {
        ASSERT_EQ(reads_open, 0u) << "round " << round << " step " << step;
        written = true;
        unsafe_after_write = ~VkPipelineStageFlags2{0};
        reads_open = 0;
      } else {
        reads_open |= stage;
      }
    }
  }
}

constexpr ImageDesc kPyramid{.width = 8, .height = 8, .layers = 2, .mips = 3, .format = VK_FORMAT_R32_SFLOAT};

UseInfo image_use(UseKind kind) {
  return describe_use({true, 0, kind, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT});
}

TEST(ImageBarriers, MipsAndLayersHaveStatesOfTheirOwn) {
  ImageState state;
  std::vector<Barrier> barriers;
  advance(state, kPyramid, image_use(UseKind::kTransferWrite), kWholeImage, barriers);
  EXPECT_EQ(barriers.size(), 1u);
  barriers.clear();
  advance(state, kPyramid, image_use(UseKind::kSampled), mip_of(0), barriers);
  ASSERT_EQ(barriers.size(), 2u);  // a layer each
  EXPECT_EQ(barriers[1].part, (Subresource{0, 1}));
  barriers.clear();
  advance(state, kPyramid, image_use(UseKind::kStorageWrite), {1, 0}, barriers);
  ASSERT_EQ(barriers.size(), 1u);
  EXPECT_EQ(barriers[0].from_layout, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  barriers.clear();
  advance(state, kPyramid, image_use(UseKind::kSampled), mip_of(0), barriers);
  EXPECT_TRUE(barriers.empty());
}

TEST(ImageBarriers, AWholeImageIsOneAgainOnceItsPartsAreAlike) {
  ImageState state;
  std::vector<Barrier> barriers;
  for (std::uint32_t mip = 0; mip < kPyramid.mips; ++mip)
    advance(state, kPyramid, image_use(UseKind::kStorageWrite), mip_of(mip), barriers);
  EXPECT_TRUE(state.parts.empty());
  barriers.clear();
  advance(state, kPyramid, image_use(UseKind::kSampled), kWholeImage, barriers);
  EXPECT_EQ(barriers.size(), 1u);
  EXPECT_EQ(barriers[0].part, kWholeImage);
}

TEST(Plan, TransientsShareMemoryOnlyWhenTheirLivesAreApart) {
  GraphContext context;
  FrameGraph graph(context);
  const std::vector<std::uint32_t> data(64);
  const BufferHandle input = graph.upload("input", std::span<const std::uint32_t>(data));
  const BufferHandle a = scale(graph, input, 64);
  const BufferHandle b = scale(graph, a, 64);
  const BufferHandle c = scale(graph, b, 64);
  const BufferHandle other = scale(graph, c, 32);
  graph.read_back(other);
  const Plan plan = make_plan(graph);
  EXPECT_EQ(plan.buffer_slots[input.index], UINT32_MAX);
  EXPECT_NE(plan.buffer_slots[a.index], plan.buffer_slots[b.index]);  // b is written while a is read
  EXPECT_EQ(plan.buffer_slots[a.index], plan.buffer_slots[c.index]);
  EXPECT_NE(plan.buffer_slots[other.index], plan.buffer_slots[a.index]);  // another size
  EXPECT_EQ(plan.buffer_pool.size(), 3u);
}

void record(FrameGraph& graph) {
  graph.note_recorded(make_plan(graph).is_alive);
}

// Declares a history and writes it; whether it was fresh.
bool write_history(FrameGraph& graph, std::uint64_t count) {
  bool fresh = false;
  BufferHandle history = graph.history_buffer("cache", count, 4, fresh);
  graph.fill("write", history, 0);
  return fresh;
}

TEST(Histories, KeepTheirNameAndTellWhenTheyAreFresh) {
  GraphContext context;
  for (const bool expected : {true, false}) {
    FrameGraph graph(context);
    EXPECT_EQ(write_history(graph, 16), expected);
    record(graph);
  }
  FrameGraph resized(context);
  EXPECT_TRUE(write_history(resized, 32));
}

TEST(Histories, AreFreshAfterAFrameThatWasDeclaredAndDropped) {
  GraphContext context;
  const auto run = [&](bool records) {
    FrameGraph graph(context);
    const bool fresh = write_history(graph, 16);
    if (records) record(graph);
    return fresh;
  };
  EXPECT_TRUE(run(false));
  EXPECT_TRUE(run(true));
  EXPECT_FALSE(run(true));
  EXPECT_FALSE(run(false));
  EXPECT_TRUE(run(true));
}

TEST(Histories, OfTwoScopesAreTwo) {
  GraphContext context;
  for (int frame = 0; frame < 2; ++frame) {
    FrameGraph graph(context);
    EXPECT_EQ(write_history(graph, 16), frame == 0);
    const FrameGraph::Scope view = graph.enter("view: ", false);
    EXPECT_EQ(write_history(graph, 32), frame == 0);
    EXPECT_EQ(graph.buffers().back().name, "view: cache");
    record(graph);
  }
}

// Last frame's mean of `light`, and this frame's.
BufferHandle accumulate(FrameGraph& graph, const BufferPair& pair) {
  BufferHandle current = pair.current;
  graph.compute("accumulate", kernels::testing_scale_comp)
      .read("source", pair.previous)
      .write("target", current)
      .push(glsl::ScaleParams{16, 2})
      .dispatch(1);
  return current;
}

TEST(HistoryPairs, TakeTurnsAndAreValidWhereLastFrameWroteThem) {
  GraphContext context;
  std::uint32_t last_side = 0;
  struct Step {
    bool writes, cut, valid;
  };
  const Step steps[] = {{true, false, false}, {true, false, true},  {true, true, false}, {true, false, true},
                        {false, false, true}, {true, false, false}, {true, false, true}};
  for (const Step& step : steps) {
    FrameGraph graph(context);
    const FrameGraph::Scope view = graph.enter("view: ", step.cut);
    const BufferPair pair = graph.history_pair("light", 16, 4);
    EXPECT_EQ(pair.valid, step.valid);
    if (step.valid) {
      EXPECT_EQ(graph.buffers()[pair.previous.index].history.side, last_side);
    }
    EXPECT_NE(graph.buffers()[pair.previous.index].history.side, graph.buffers()[pair.current.index].history.side);
    if (step.writes) {
      last_side = graph.buffers()[pair.current.index].history.side;
      graph.read_back(accumulate(graph, pair));
    }
    record(graph);
  }
}

bool is_alive(const FrameGraph& graph, const Plan& plan, std::string_view name) {
  for (std::size_t i = 0; i < graph.passes().size(); ++i)
    if (base_of(graph.passes()[i]).name == name) return plan.is_alive[i];
  ADD_FAILURE() << "no pass " << name;
  return false;
}

TEST(Culling, KeepsWhatLeadsToARootAndNothingElse) {
  GraphContext context;
  FrameGraph graph(context);
  const std::vector<std::uint32_t> data(64);
  const BufferHandle input = graph.upload("input", std::span<const std::uint32_t>(data));
  const BufferHandle shown = scale(graph, input, 64);
  const BufferHandle hidden = scale(graph, shown, 32);
  scale(graph, hidden, 16);
  bool ran = false;
  bool fresh = false;
  BufferHandle cache = graph.history_buffer("cache", 16, 4, fresh);
  graph.compute("fill cache", kernels::testing_scale_comp)
      .read("source", shown)
      .write("target", cache)
      .push(glsl::ScaleParams{16, 2})
      .on_recorded([&] { ran = true; })
      .dispatch(1);
  const Plan plan = make_plan(graph);
  EXPECT_EQ(plan.is_alive, (std::vector<bool>{true, false, false, true}));
  EXPECT_EQ(plan.buffer_slots[hidden.index], UINT32_MAX) << "what nobody needs takes no memory";
  graph.note_recorded(plan.is_alive);
  EXPECT_TRUE(ran);
}

TEST(Culling, WhatIsOverwrittenNeedsNoEarlierWriter) {
  GraphContext context;
  FrameGraph graph(context);
  BufferHandle buffer = graph.create_buffer("sums", 16, 4);
  graph.fill("first", buffer, 1);
  graph.fill("second", buffer, 2);
  graph.read_back(buffer);
  const Plan plan = make_plan(graph);
  EXPECT_FALSE(is_alive(graph, plan, "first"));
  EXPECT_TRUE(is_alive(graph, plan, "second"));
}

TEST(Culling, APairIsWrittenWhereSomebodyReadsItsPast) {
  GraphContext context;
  FrameGraph graph(context);
  BufferPair unread = graph.history_pair("unread", 16, 4);
  graph.fill("unread", unread.current, 0);
  accumulate(graph, graph.history_pair("light", 16, 4));
  EXPECT_EQ(make_plan(graph).is_alive, (std::vector<bool>{false, true}));
}

TEST(Culling, CallbacksOfCulledPassesAreNotRun) {
  GraphContext context;
  FrameGraph graph(context);
  bool frame_recorded = false;
  bool pass_recorded = false;
  graph.on_recorded([&] { frame_recorded = true; });
  BufferHandle buffer = graph.create_buffer("nobody's", 16, 4);
  graph.copy("copy", graph.upload_bytes("bytes", std::vector<std::byte>(64), 4), buffer, 64).callbacks.push_back([&] {
    pass_recorded = true;
  });
  record(graph);
  EXPECT_TRUE(frame_recorded);
  EXPECT_FALSE(pass_recorded);
}

TEST(Plan, BuildsShareScratchMemoryAndReadWhatTheyAreMadeOf) {
  GraphContext context;
  FrameGraph graph(context);
  AccelerationStructure standing, moving, scene;
  const AccelerationStructureHandle top = graph.import_acceleration_structure(scene);
  std::vector<AccelerationStructureHandle> bottoms;
  for (AccelerationStructure* structure : {&standing, &moving}) {
    BufferHandle corners = graph.create_buffer("corners", 1, kTriangleBytes);
    graph.fill("corners", corners, 0);
    bottoms.push_back(graph.import_acceleration_structure(*structure));
    graph.build("build", bottoms.back(), corners, false);
  }
  AccelerationStructureHandle built = top;
  graph.build("build scene", built, bottoms);
  const Plan plan = make_plan(graph);
  const std::vector<ResourceUse>& uses = plan.pass_uses.back();
  EXPECT_EQ(uses[1].index, top.index);
  EXPECT_TRUE(describe_use(uses[1]).writes);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(uses[3 + i].index, bottoms[i].index);
    EXPECT_EQ(uses[3 + i].kind, UseKind::kAccelerationStructureRead);
  }
  EXPECT_EQ(plan.buffer_pool.size(), 2u);  // the corners' and the scratch memory, each used again
}

using MisuseDeathTest = ::testing::Test;

TEST(MisuseDeathTest, StaleHandlesAreNamed) {
  GraphContext context;
  FrameGraph graph(context);
  BufferHandle buffer = graph.create_buffer("radiance", 64, 4);
  const BufferHandle old = buffer;
  graph.fill("clear", buffer, 0);
  EXPECT_DEATH(scale(graph, old, 64), "stale handle of radiance");
}

TEST(MisuseDeathTest, ATopLevelOfAnOldBottomLevel) {
  GraphContext context;
  FrameGraph graph(context);
  AccelerationStructure bottom, top;
  const AccelerationStructureHandle old = graph.import_acceleration_structure(bottom);
  AccelerationStructureHandle built = old;
  BufferHandle corners = graph.create_buffer("corners", 1, kTriangleBytes);
  graph.fill("corners", corners, 0);
  graph.build("build", built, corners, false);
  AccelerationStructureHandle scene = graph.import_acceleration_structure(top);
  EXPECT_DEATH(graph.build("build scene", scene, {&old, 1}), "build scene: stale handle");
}

TEST(MisuseDeathTest, APassThatWasBegunBeforeTheWriterOfWhatItReads) {
  GraphContext context;
  FrameGraph graph(context);
  ComputePass& early = graph.compute("early", kernels::testing_scale_comp);
  BufferHandle buffer = graph.create_buffer("radiance", 64, 4);
  graph.fill("late", buffer, 0);
  EXPECT_DEATH(early.read("source", buffer), "early was begun before late");
}

TEST(MisuseDeathTest, ReadingWhatNothingWrote) {
  GraphContext context;
  FrameGraph graph(context);
  graph.read_back(scale(graph, graph.create_buffer("radiance", 64, 4), 64));
  EXPECT_DEATH(make_plan(graph), "scale reads radiance, which nothing wrote");
}

TEST(MisuseDeathTest, BindingsAreCheckedAgainstTheShader) {
  GraphContext context;
  FrameGraph graph(context);
  BufferHandle buffer = graph.create_buffer("radiance", 64, 4);
  graph.fill("clear", buffer, 0);
  BufferHandle pairs = graph.create_buffer("pairs", 64, 8);
  graph.fill("clear", pairs, 0);
  ComputePass& pass = graph.compute("scale", kernels::testing_scale_comp);
  EXPECT_DEATH(pass.read("sauce", buffer), "no binding 'sauce'");
  EXPECT_DEATH(pass.write("source", buffer), "is written but `readonly`");
  EXPECT_DEATH(pass.read("target", buffer), "is read only but not `readonly`");
  EXPECT_DEATH(pass.read("source", pairs), "8 bytes on the host, 4 in the shader");
  EXPECT_DEATH(pass.constant("kMissing", 1), "no specialisation constant");
}

struct WrongParams {
  std::uint32_t factor, count;
  static std::span<const ParamMember> members() {
    static const ParamMember all[] = {{"factor", 0, 4}, {"count", 4, 4}};
    return all;
  }
};

TEST(MisuseDeathTest, ParametersAreCheckedByNameAndOffset) {
  GraphContext context;
  FrameGraph graph(context);
  ComputePass& pass = graph.compute("scale", kernels::testing_scale_comp);
  EXPECT_DEATH(pass.push(WrongParams{1, 2}), "parameter 'count' lies at 4 .* on the host, at 0");
}

TEST(Reflection, ReadsBindingsParametersAndWorkgroup) {
  const Reflection r = reflect(kernels::testing_scale_comp);
  ASSERT_EQ(r.bindings.size(), 2u);
  EXPECT_EQ(r.bindings[0].name, "source");
  EXPECT_FALSE(r.bindings[0].writable);
  EXPECT_EQ(r.bindings[1].name, "target");
  EXPECT_TRUE(r.bindings[1].writable);
  EXPECT_EQ(r.bindings[1].stride, 4u);
  EXPECT_EQ(r.workgroup[0], 64u);
  EXPECT_EQ(r.push_size, 8u);
  ASSERT_EQ(r.spec_constants.size(), 1u);
  EXPECT_EQ(r.spec_constants[0].name, "kOffset");
}

TEST(Reflection, KnowsAccelerationStructures) {
  const Reflection r = reflect(kernels::testing_probe_comp);
  ASSERT_EQ(r.bindings.size(), 2u);
  EXPECT_EQ(r.bindings[0].name, "structure");
  EXPECT_EQ(r.bindings[0].type, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR);
  EXPECT_FALSE(r.bindings[0].writable);
}

}  // namespace
}  // namespace lightwell
