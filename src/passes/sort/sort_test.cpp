#include "passes/sort/sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include <glm/ext/vector_uint2.hpp>

#include "graph/testing/graph_test.h"
#include "passes/sort/sort_types.h"

namespace lightwell {
namespace {

class SortTest : public GraphTest {
 protected:
  std::vector<glm::uvec2> sort(const std::vector<glm::uvec2>& keys, std::uint32_t bits) {
    FrameGraph graph(executor().context());
    const BufferHandle uploaded = graph.upload<glm::uvec2>("keys", keys);
    const ReadbackTicket ticket =
        graph.read_back(record_sort(graph, "sort", uploaded, static_cast<std::uint32_t>(keys.size()), bits));
    run(graph);
    return fetch<glm::uvec2>(ticket);
  }
};

TEST_F(SortTest, EqualsAStableSort) {
  std::mt19937 random(7);
  for (const std::size_t count : {1u, 63u, 512u, 513u, 20000u}) {
    for (const std::uint32_t bits : {6u, 15u, 32u}) {
      std::vector<glm::uvec2> keys(count);
      for (std::uint32_t i = 0; i < count; ++i) keys[i] = {random() & (bits == 32 ? ~0u : (1u << bits) - 1u), i};
      std::vector<glm::uvec2> expected = keys;
      std::stable_sort(expected.begin(), expected.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
      EXPECT_EQ(sort(keys, bits), expected) << count << " keys of " << bits << " bits";
    }
  }
}

TEST_F(SortTest, AddsUpWhatComesBefore) {
  std::mt19937 random(11);
  for (const std::uint32_t count : {1u, 64u, 65u, 30000u}) {
    std::vector<std::uint32_t> elements(count);
    for (std::uint32_t& element : elements) element = random() & 0xffffu;
    FrameGraph graph(executor().context());
    const PrefixSums sums =
        record_prefix_sums(graph, "add up", graph.upload<std::uint32_t>("elements", elements), count);
    const ReadbackTicket tickets[] = {graph.read_back(sums.sums), graph.read_back(sums.blocks)};
    run(graph);
    const auto within = fetch<std::uint32_t>(tickets[0]);
    const auto before = fetch<glm::uvec2>(tickets[1]);
    std::uint32_t expected = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      ASSERT_EQ(within[i] + before[i / glsl::kScanBlock].x, expected) << "element " << i << " of " << count;
      expected += elements[i];
    }
  }
}

}  // namespace
}  // namespace lightwell
