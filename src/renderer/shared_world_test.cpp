// Which views share a technique's world part, and how long it lives.
#include "renderer/shared_world.h"

#include <gtest/gtest.h>

#include "graph/testing/graph_test.h"
#include "renderer/options.h"
#include "renderer/test_scene.h"

namespace lightwell {
namespace {

std::string key_of(const RendererOptions& options) {
  return world_key(options, *create_technique(options), LightKinds::kBounced);
}

TEST(WorldKey, NamesTheTechniqueItsPresetAndTheOptionsOfTheWorld) {
  RendererOptions options;
  options.technique = "light-volume";
  const std::string key = key_of(options);
  options.preset = "best";  // the first, which is the default
  EXPECT_EQ(key_of(options), key);
  options.technique_options = {"links=64"};
  EXPECT_NE(key_of(options), key);
  options.technique_options = {};
  options.preset = "paper";
  EXPECT_NE(key_of(options), key);
}

TEST(WorldKey, LeavesOutTheOptionsOfAView) {
  RendererOptions options;
  options.technique = "ambient";
  const std::string key = key_of(options);
  options.technique_options = {"irradiance=0.25"};
  EXPECT_EQ(key_of(options), key);
}

class CountedWorld final : public TechniqueWorld {
 public:
  explicit CountedWorld(int& alive) : alive_(alive) { ++alive_; }
  ~CountedWorld() override { --alive_; }
  void record_world(FrameGraph&, WorldFrame&) override {}

 private:
  int& alive_;
};

class CountedTechnique final : public Technique {
 public:
  void describe(OptionVisitor&) override {}
  std::unique_ptr<TechniqueWorld> create_world(LightKinds) const override {
    return std::make_unique<CountedWorld>(alive);
  }
  GiResult record_view(FrameGraph&, TechniqueWorld*, ViewFrame&) override { return {}; }

  mutable int alive = 0;
};

// Keeps a history as any technique may.
class RememberingWorld final : public TechniqueWorld {
 public:
  void record_world(FrameGraph& graph, WorldFrame&) override {
    BufferPair pair = graph.history_pair("pair", 4, sizeof(float));
    is_valid = pair.valid;
    BufferHandle last = graph.create_buffer("last", 4, sizeof(float));
    if (is_valid) graph.copy("read", pair.previous, last, graph.desc(last).size);
    graph.fill("write", pair.current, 0);
    graph.read_back(pair.current);
  }

  bool is_valid = false;
};

using SharedWorldTest = GraphTest;

TEST_F(SharedWorldTest, APartGoesWithTheLastViewThatHoldsIt) {
  TestScene test;
  test.add_wall(test.add_material(glm::vec3(0.5f)));
  SharedWorld shared(device(), test.scene, take_snapshot(test.scene), {});
  CountedTechnique technique;
  auto first = shared.find_part("key", "name", technique, LightKinds::kBounced);
  auto second = shared.find_part("key", "name", technique, LightKinds::kBounced);
  EXPECT_EQ(first, second);
  const std::string scope = first->scope;
  first.reset();
  EXPECT_EQ(technique.alive, 1);
  second.reset();
  EXPECT_EQ(technique.alive, 0);
  // Histories are kept for a while under the name of the one that went: the next one has others.
  EXPECT_NE(shared.find_part("key", "name", technique, LightKinds::kBounced)->scope, scope);
}

TEST_F(SharedWorldTest, ACutForgetsThePartsHistories) {
  TestScene test;
  test.add_wall(test.add_material(glm::vec3(0.5f)));
  const SceneSnapshot snapshot = take_snapshot(test.scene);
  SharedWorld shared(device(), test.scene, snapshot, {});
  auto remembering = std::make_unique<RememberingWorld>();
  const RememberingWorld& technique = *remembering;
  SharedWorld::Part part{.scope = "part: ", .technique = std::move(remembering)};
  for (const auto& [cut, valid] : {std::pair{false, false}, {false, true}, {true, false}, {false, true}}) {
    FrameGraph graph(executor().context());
    WorldFrame world(graph, shared.world(), snapshot, 0.0, cut);
    SharedWorld::record(part, graph, world);
    run(graph);
    EXPECT_EQ(technique.is_valid, valid);
  }
}

}  // namespace
}  // namespace lightwell
