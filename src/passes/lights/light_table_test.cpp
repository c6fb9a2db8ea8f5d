#include "passes/lights/light_table.h"

#include <gtest/gtest.h>

#include <cstring>

#include "shaders/lights.h"

namespace lightwell {
namespace {

class LightTableTest : public ::testing::Test {
 protected:
  // Revision of the table, then those of its lights.
  std::vector<std::uint64_t> revisions() {
    FrameGraph graph(context_);
    const LightTable::Frame frame = table_.record(graph, lights);
    std::vector<std::uint64_t> all{frame.revision};
    all.insert(all.end(), frame.revisions.begin(), frame.revisions.end());
    return all;
  }

  std::vector<WorldLight> lights = std::vector<WorldLight>(3);

 private:
  GraphContext context_;
  LightTable table_;
};

TEST_F(LightTableTest, UploadsTheLightsInTheirOrder) {
  WorldLight spot;
  spot.type = LightType::kSpot;
  spot.position = {1, 2, 3};
  spot.direction = {0, -1, 0};
  spot.intensity = {4, 5, 6};
  spot.cos_inner = 0.9f;
  spot.cos_outer = 0.7f;
  GraphContext context;
  FrameGraph graph(context);
  LightTable table;
  const LightTable::Frame frame = table.record(graph, std::vector<WorldLight>{WorldLight{}, spot});
  ASSERT_EQ(frame.count, 2u);
  const std::vector<std::byte>& bytes = graph.buffers()[frame.lights.index].data;
  ASSERT_EQ(bytes.size(), 2 * sizeof(glsl::GpuLight));
  glsl::GpuLight uploaded;
  std::memcpy(&uploaded, bytes.data() + sizeof(uploaded), sizeof(uploaded));
  EXPECT_EQ(uploaded.type, glsl::kLightSpot);
  EXPECT_EQ(uploaded.position, spot.position);
  EXPECT_EQ(uploaded.direction, spot.direction);
  EXPECT_EQ(uploaded.intensity, spot.intensity);
  EXPECT_EQ(uploaded.cos_inner, spot.cos_inner);
  EXPECT_EQ(uploaded.cos_outer, spot.cos_outer);
  EXPECT_EQ(frame.world[1].position, spot.position);
}

TEST_F(LightTableTest, NothingChangesWhileTheLightsStay) {
  EXPECT_EQ(revisions(), revisions());
}

TEST_F(LightTableTest, ALightThatChangesIsToldAlone) {
  const auto change = [&](auto&& edit) {
    const std::vector<std::uint64_t> before = revisions();
    edit(lights[1]);
    const std::vector<std::uint64_t> after = revisions();
    EXPECT_NE(after[0], before[0]);
    EXPECT_EQ(after[1], before[1]);
    EXPECT_NE(after[2], before[2]);
    EXPECT_EQ(after[3], before[3]);
  };
  change([](WorldLight& light) { light.position.y = 1.0f; });
  change([](WorldLight& light) { light.intensity.x = 2.0f; });
  change([](WorldLight& light) { light.type = LightType::kSpot; });
  change([](WorldLight& light) { light.direction = {1, 0, 0}; });
  change([](WorldLight& light) { light.cos_inner = 0.8f; });
  change([](WorldLight& light) { light.cos_outer = 0.3f; });
}

TEST_F(LightTableTest, LightsThatComeAndGoAreTold) {
  const std::vector<std::uint64_t> three = revisions();
  lights.pop_back();
  const std::vector<std::uint64_t> two = revisions();
  EXPECT_NE(two[0], three[0]);
  EXPECT_EQ(two[1], three[1]);
  lights.emplace_back();
  const std::vector<std::uint64_t> again = revisions();
  EXPECT_NE(again[0], two[0]);
  EXPECT_EQ(again[1], three[1]);
  EXPECT_NE(again[3], three[3]);  // it was away
}

}  // namespace
}  // namespace lightwell
