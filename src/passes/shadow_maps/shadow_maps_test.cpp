// Which maps are drawn when, and that what is left out never shows.
#include "passes/shadow_maps/shadow_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "core/log.h"
#include "graph/testing/graph_test.h"
#include "passes/shadow_maps/shadow_params.h"
#include "passes/shadow_maps/shadow_views.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kTileSide = 64;

WorldLight make_light(LightType type, const glm::vec3& position, const glm::vec3& direction, float cos_outer = 0.8f) {
  return {.type = type,
          .position = position,
          .direction = glm::normalize(direction),
          .intensity = glm::vec3(1.0f),
          .cos_inner = 1.0f,
          .cos_outer = cos_outer};
}

// "textured" has few triangles, some of them alpha-masked.
class ShadowMapsTest : public GraphTest {
 protected:
  void SetUp() override {
    GraphTest::SetUp();
    if (!IsSkipped()) load("textured");
  }

  void load(const std::string& name) {
    scene_ = load_scene(resolve_scene(name));
    world = take_snapshot(scene_);
    world.lights = {make_light(LightType::kPoint, {0, 2, 0.5f}, {0, -1, 0}),
                    make_light(LightType::kSpot, {2, 3, 1}, {-1, -1, -0.5f}),
                    make_light(LightType::kDirectional, {}, {-0.3f, -1, -0.4f}),
                    make_light(LightType::kPoint, {30, 90, 60}, {0, -1, 0}),
                    make_light(LightType::kSpot, {-2, 2.5f, 1}, {0, -1, 0.2f}, 0.1f)};
    gpu_scene = std::make_unique<GpuScene>(device(), scene_, world);
    maps = std::make_unique<ShadowMaps>(device());
  }

  struct Drawn {
    std::set<std::uint32_t> lights;  // whose maps were drawn; beyond the lights, wider views
    std::uint64_t indices = 0;
    std::vector<float> atlas;
  };

  // Draws what of `maps` must be drawn for the next frame. `culling`: false: as if every part were everywhere.
  Drawn next(bool culling = true) {
    FrameGraph graph(executor().context());
    GpuScene::Frame scene = gpu_scene->record(graph, world);
    std::vector<PartRange> everywhere(scene.parts.begin(), scene.parts.end());
    for (PartRange& part : everywhere) part.world_bounds = world.bounds;
    if (!culling) scene.parts = everywhere;
    const LightTable::Frame lights = light_table_.record(graph, world.lights);
    const ShadowMaps::Frame frame = maps->record(graph, scene, lights, world.bounds, balls, kTileSide);
    Drawn drawn;
    for (const Pass& any : graph.passes()) {
      const RasterPass* pass = std::get_if<RasterPass>(&any);
      if (!pass || !pass->name.starts_with("shadow maps")) continue;
      for (const DrawCall& draw : pass->draws) {
        glsl::ShadowParams params;
        std::memcpy(&params, draw.push.bytes.data(), sizeof(params));
        drawn.lights.insert(params.view);
        drawn.indices += draw.count;
      }
    }
    const ReadbackTicket ticket = graph.read_back(frame.atlas);
    run(graph);
    drawn.atlas = fetch<float>(ticket);
    return drawn;
  }

  // By maps that have drawn nothing before.
  std::vector<float> draw_anew(bool culling = true) {
    const std::unique_ptr<ShadowMaps> kept = std::exchange(maps, std::make_unique<ShadowMaps>(device()));
    const Drawn drawn = next(culling);
    EXPECT_EQ(drawn.lights.size(), world.lights.size());
    return drawn.atlas;
  }

  SceneSnapshot world;  // of the next frame
  std::vector<FocusBall> balls;
  std::unique_ptr<GpuScene> gpu_scene;
  std::unique_ptr<ShadowMaps> maps;

 private:
  Scene scene_;
  LightTable light_table_;
};

using Lights = std::set<std::uint32_t>;

TEST_F(ShadowMapsTest, WhatIsCulledNeverShows) {
  for (const char* name : {"textured", "arena"}) {
    load(name);
    const Drawn culled = next();
    maps = std::make_unique<ShadowMaps>(device());
    const Drawn all = next(false);
    EXPECT_GT(*std::max_element(all.atlas.begin(), all.atlas.end()), 0.0f);
    EXPECT_EQ(culled.atlas, all.atlas) << name;
    RecordProperty(std::string(name) + "_culled", std::to_string(1.0 - double(culled.indices) / double(all.indices)));
    if (std::string(name) == "arena") {
      EXPECT_LT(culled.indices, 2 * all.indices / 3);
    }
  }
}

TEST_F(ShadowMapsTest, ALightThatMovesRedrawsItsOwnMaps) {
  EXPECT_EQ(next().lights, (Lights{0, 1, 2, 3, 4}));
  EXPECT_EQ(next().lights, Lights{});
  for (const std::uint32_t moved : {0u, 1u, 3u, 4u}) {
    world.lights[moved].position += glm::vec3(0.05f, -0.02f, 0.03f);
    const Drawn drawn = next();
    EXPECT_EQ(drawn.lights, Lights{moved});
    EXPECT_EQ(drawn.atlas, draw_anew()) << "light " << moved;
    next();  // draw_anew() has written the atlas behind the back of `maps`, with the same content
  }
  world.lights[2].direction = glm::normalize(glm::vec3(0.2f, -1.0f, -0.5f));
  EXPECT_EQ(next().lights, Lights{2});
}

TEST_F(ShadowMapsTest, LightThatOnlyGetsBrighterRedrawsNothing) {
  next();
  for (WorldLight& light : world.lights) light.intensity *= 3.0f;
  EXPECT_EQ(next().lights, Lights{});
}

TEST_F(ShadowMapsTest, GeometryThatMovesRedrawsAllMaps) {
  next();
  for (MeshInstance& instance : world.instances)
    instance.to_world = glm::translate(glm::mat4(1.0f), {0, 0.1f, 0}) * instance.to_world;
  const Drawn drawn = next();
  EXPECT_EQ(drawn.lights, (Lights{0, 1, 2, 3, 4}));
  EXPECT_EQ(drawn.atlas, draw_anew());
}

// Light 2 is a sun, 3 a lamp far away; what they see of the whole scene and of wider balls is behind the lights.
TEST_F(ShadowMapsTest, ABallThatMovesRedrawsItsViewsAlone) {
  balls = {{{0, 1, 0}, 0.5f}, {{0, 1, 0}, 2.0f}};
  EXPECT_EQ(next().lights, (Lights{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(next().lights, Lights{});
  balls[0].center.x += 0.25f;
  const Drawn drawn = next();
  EXPECT_EQ(drawn.lights, (Lights{2, 3}));
  balls[1].center.z += 0.5f;
  EXPECT_EQ(next().lights, (Lights{5, 7}));
  const std::vector<float> kept = next().atlas;
  maps = std::make_unique<ShadowMaps>(device());
  EXPECT_EQ(next().atlas, kept);
}

TEST_F(ShadowMapsTest, LightsThatComeAndGoFindTheirMaps) {
  next();
  const std::vector<WorldLight> all = world.lights;
  world.lights.erase(world.lights.begin() + 1);
  EXPECT_EQ(next().atlas, draw_anew());
  world.lights = all;
  EXPECT_EQ(next().atlas, draw_anew());
}

TEST_F(ShadowMapsTest, WarnsOnceWhereTheAtlasIsTooSmall) {
  const WarningCapture capture;
  next();
  EXPECT_TRUE(capture.warnings().empty());
  world.lights.assign(12000, world.lights[0]);
  for (int frame = 0; frame < 2; ++frame) {
    FrameGraph graph(executor().context());
    const GpuScene::Frame scene = gpu_scene->record(graph, world);
    LightTable table;
    maps->record(graph, scene, table.record(graph, world.lights), world.bounds, {}, kTileSide);
  }
  ASSERT_EQ(capture.warnings().size(), 1u);
  EXPECT_NE(capture.warnings()[0].find("shadow_map_size"), std::string::npos);
  EXPECT_NE(capture.warnings()[0].find("cast no shadows"), std::string::npos);
}

}  // namespace
}  // namespace lightwell
