// The points that lights are sampled with.
#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>

#include "graph/testing/graph_test.h"
#include "kernels/passes/sampled_lights/testing/points.comp.h"
#include "passes/sampled_lights/testing/points.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSide = 16;    // pixels
constexpr std::uint32_t kCount = 256;  // points a pixel

class StratifiedPoints : public GraphTest {
 protected:
  void SetUp() override {
    GraphTest::SetUp();
    if (IsSkipped()) return;
    FrameGraph graph(executor().context());
    BufferHandle points = graph.create_buffer("points", kCount * kSide * kSide, sizeof(glm::vec2));
    graph.compute("points", kernels::sampled_lights_testing_points_comp)
        .write("points", points)
        .push(glsl::PointsParams{{kSide, kSide}, kCount, 1})
        .dispatch_threads(kSide, kSide);
    const ReadbackTicket ticket = graph.read_back(points);
    run(graph);
    points_ = fetch<glm::vec2>(ticket);
  }

  glm::vec2 point(std::uint32_t x, std::uint32_t y, std::uint32_t i) const {
    return points_[(i * kSide + y) * kSide + x];
  }

  std::vector<glm::vec2> points_;
};

// Of 2^k points each of the 2^k equal rectangles of any shape a x b, a b = 2^k, holds one.
void expect_stratified(const std::vector<glm::vec2>& points) {
  const auto count = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t columns = 1; columns <= count; columns *= 2) {
    std::vector<int> hits(count);
    for (const glm::vec2& p : points) {
      ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f);
      const auto column = static_cast<std::uint32_t>(p.x * static_cast<float>(columns));
      const auto row = static_cast<std::uint32_t>(p.y * static_cast<float>(count / columns));
      ++hits[row * columns + column];
    }
    for (const int hit : hits) ASSERT_EQ(hit, 1) << columns << " columns of " << count << " points";
  }
}

TEST_F(StratifiedPoints, APixelsSequenceIsStratifiedAtEveryPowerOfTwo) {
  for (const std::uint32_t x : {0u, 1u, 6u, 15u}) {
    for (const std::uint32_t count : {4u, 16u, 64u, 256u}) {
      for (std::uint32_t first = 0; first < kCount; first += count) {
        std::vector<glm::vec2> points;
        for (std::uint32_t i = 0; i < count; ++i) points.push_back(point(x, 15 - x, first + i));
        expect_stratified(points);
      }
    }
  }
}

TEST_F(StratifiedPoints, ABlocksPixelsShareTheSquareInEveryFrame) {
  for (const std::uint32_t i : {0u, 1u, 5u, 100u, 255u}) {
    for (std::uint32_t block = 0; block < 16; ++block) {
      int hits[4][4] = {};
      for (std::uint32_t p = 0; p < 16; ++p) {
        const glm::vec2 at = point(4 * (block % 4) + p % 4, 4 * (block / 4) + p / 4, i);
        EXPECT_EQ(hits[static_cast<int>(4.0f * at.x)][static_cast<int>(4.0f * at.y)]++, 0) << "frame " << i;
      }
    }
  }
}

// Two pixels of a block have all strata in common after 16 points, and must not have the points.
TEST_F(StratifiedPoints, NeighboursDoNotRepeatEachOther) {
  for (std::uint32_t p = 1; p < 16; ++p) {
    double nearest_sum = 0.0;
    for (std::uint32_t i = 0; i < 16; ++i) {
      float nearest = 1.0f;
      for (std::uint32_t j = 0; j < 16; ++j)
        nearest = std::min(nearest, glm::distance(point(0, 0, i), point(p % 4, p / 4, j)));
      nearest_sum += nearest;
    }
    EXPECT_GT(nearest_sum / 16.0, 0.02) << "pixel " << p;
  }
}

}  // namespace
}  // namespace lightwell
