#include "passes/light_clusters/light_clusters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include "core/luminance.h"
#include "graph/testing/graph_test.h"
#include "passes/light_clusters/light_sampler.h"
#include "passes/light_clusters/testing/light_points.h"

namespace lightwell {
namespace {

constexpr Bounds kBounds{glm::vec3(-2.0f), glm::vec3(2.0f)};

class LightClustersTest : public GraphTest {
 protected:
  struct Clusters {
    std::vector<glm::uvec2> order;
    std::vector<glsl::LightPoint> points;
    std::vector<float> running;
    std::vector<glsl::LightCluster> clusters;
  };

  Clusters make(const std::vector<glsl::LightPoint>& points) {
    FrameGraph graph(executor().context());
    const LightClusters made = record_light_clusters(graph, graph.upload<glsl::LightPoint>("points", points),
                                                     static_cast<std::uint32_t>(points.size()), kBounds);
    const ReadbackTicket tickets[] = {graph.read_back(made.order), graph.read_back(made.points),
                                      graph.read_back(made.running), graph.read_back(made.clusters),
                                      graph.read_back(made.counts)};
    run(graph);
    Clusters result{fetch<glm::uvec2>(tickets[0]), fetch<glsl::LightPoint>(tickets[1]), fetch<float>(tickets[2]),
                    fetch<glsl::LightCluster>(tickets[3])};
    const auto counts = fetch<std::uint32_t>(tickets[4]);
    std::uint32_t count = 0;
    for (std::uint32_t shift = 0; shift < glsl::kClusterShifts && count == 0; ++shift)
      if (counts[shift] <= glsl::kMostClusters) count = counts[shift];
    result.clusters.resize(count);
    return result;
  }

  // Every point with light is in one cluster, which holds it and knows its light.
  void check(const std::vector<glsl::LightPoint>& points) {
    const Clusters made = make(points);
    std::set<std::uint32_t> seen;
    std::uint32_t last_key = 0;
    for (const glsl::LightCluster& cluster : made.clusters) {
      ASSERT_GE(cluster.count, 1u);
      EXPECT_TRUE(seen.empty() || cluster.key > last_key);
      last_key = cluster.key;
      double flux = 0.0;
      for (std::uint32_t i = cluster.first; i < cluster.first + cluster.count; ++i) {
        const glsl::LightPoint& point = made.points[i];
        const glsl::LightPoint& own = points[made.order[i].y];
        EXPECT_EQ(point.position, own.position);
        EXPECT_TRUE(seen.insert(made.order[i].y).second);
        EXPECT_LE(glm::distance(point.position, cluster.center), cluster.radius * 1.0001f + 1e-6f);
        flux += luminance(glm::dvec3(point.flux));
        EXPECT_NEAR(made.running[i], flux, 1e-4 * flux);
        EXPECT_GT(glm::dot(unpack_unit_vector(point.normal), cluster.axis), 0.0f);
      }
      EXPECT_NEAR(cluster.flux, flux, 1e-4 * flux);
    }
    std::size_t lit = 0;
    for (const glsl::LightPoint& point : points) lit += point.flux != glm::vec3(0.0f) ? 1 : 0;
    EXPECT_EQ(seen.size(), lit);
    EXPECT_LE(made.clusters.size(), std::size_t{glsl::kMostClusters});
    EXPECT_TRUE(lit == 0 || !made.clusters.empty());
  }
};

TEST_F(LightClustersTest, HoldEveryPointOnce) {
  for (const std::uint32_t count : {1u, 64u, 1000u, 20000u}) check(random_light_points(count, kBounds, count));
}

TEST_F(LightClustersTest, LeaveOutPointsWithoutLight) {
  std::vector<glsl::LightPoint> points = random_light_points(500, kBounds, 3);
  for (std::size_t i = 0; i < points.size(); i += 3) points[i].flux = glm::vec3(0.0f);
  check(points);
  for (glsl::LightPoint& point : points) point.flux = glm::vec3(0.0f);
  check(points);
}

TEST_F(LightClustersTest, TakeManyPointsInOnePlace) {
  std::vector<glsl::LightPoint> points = random_light_points(3000, kBounds, 5);
  for (glsl::LightPoint& point : points) {
    point.position = glm::vec3(0.5f);
    point.normal = points[0].normal;
  }
  check(points);
  EXPECT_EQ(make(points).clusters.size(), 1u);
}

TEST_F(LightClustersTest, KeepTheirKeysWhereOtherPointsComeAndGo) {
  const std::vector<glsl::LightPoint> points = random_light_points(200, kBounds, 9);
  std::vector<glsl::LightPoint> half(points.begin(), points.begin() + 100);
  std::map<std::uint32_t, std::uint32_t> keys;  // by the point's number
  const auto note = [&](const Clusters& made) {
    for (const glsl::LightCluster& cluster : made.clusters)
      for (std::uint32_t i = cluster.first; i < cluster.first + cluster.count; ++i) {
        const auto [entry, is_new] = keys.emplace(made.order[i].y, cluster.key);
        EXPECT_EQ(entry->second, cluster.key);
      }
  };
  note(make(points));
  note(make(half));
}

}  // namespace
}  // namespace lightwell
