// Directions about a normal, as the device computes them.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "graph/linear_dispatch.h"
#include "graph/testing/graph_test.h"
#include "kernels/passes/sampled_lights/testing/cosine_directions.comp.h"
#include "passes/sampled_lights/testing/cosine_directions.h"

namespace lightwell {
namespace {

class HemisphereTest : public GraphTest {
 protected:
  std::vector<glm::vec4> directions(const std::vector<glsl::CosineQuestion>& questions) {
    const auto count = static_cast<std::uint32_t>(questions.size());
    FrameGraph graph(executor().context());
    BufferHandle directions = graph.create_buffer("directions", count, sizeof(glm::vec4));
    dispatch_linear(graph.compute("cosine directions", kernels::sampled_lights_testing_cosine_directions_comp)
                        .read("questions", graph.upload<glsl::CosineQuestion>("questions", questions))
                        .write("directions", directions)
                        .push(glsl::CosineDirectionsParams{count}),
                    count);
    const ReadbackTicket ticket = graph.read_back(directions);
    run(graph);
    return fetch<glm::vec4>(ticket);
  }
};

// Half of the numbers lie on or beside the edge of the unit square, which becomes the horizon.
TEST_F(HemisphereTest, CosineDirectionsLieAboveTheHorizon) {
  constexpr unsigned kSeed = 15;
  constexpr std::size_t kCount = 1u << 18;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 engine(kSeed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  const auto number = [&] { return std::min(unit(engine), 1.0f - 0x1p-24f); };
  std::vector<glsl::CosineQuestion> questions;
  for (std::size_t i = 0; i < kCount; ++i) {
    glm::vec3 normal(0.0f);
    normal[static_cast<int>(i / 4 % 3)] = i / 12 % 2 == 0 ? 1.0f : -1.0f;
    if (i / 24 % 2 == 1) normal = glm::normalize(glm::vec3(number(), number(), number()) - 0.5f);
    glm::vec2 numbers(number(), number());
    const float inset = i % 8 < 4 ? 0.0f : 1e-4f * number();
    if (i % 2 == 0) numbers[static_cast<int>(i / 2 % 2)] = i % 16 < 8 ? inset : 1.0f - std::max(inset, 0x1p-24f);
    questions.push_back({.normal = normal, .numbers = numbers});
  }
  const std::vector<glm::vec4> found = directions(questions);
  std::size_t below = 0, not_unit = 0;
  double most = 0.0;  // of the error of squared cosines
  for (std::size_t i = 0; i < kCount; ++i) {
    const glm::vec3 direction(found[i]);
    const float cosine = glm::dot(direction, questions[i].normal);
    below += !(cosine > 0.0f);
    not_unit += !(std::abs(glm::length(direction) - 1.0f) < 1e-6f);
    const glm::vec2 square = 2.0f * questions[i].numbers - 1.0f;
    const double radius = std::max(std::abs(square.x), std::abs(square.y));
    most = std::max(most, std::abs(cosine * cosine - (1.0 - radius * radius)));
  }
  EXPECT_EQ(below, 0u) << "on or below the horizon";
  EXPECT_EQ(not_unit, 0u);
  EXPECT_LT(most, 2e-3);  // sine and cosine may be wrong by 2^-11: so much in the sum of their squares
}

}  // namespace
}  // namespace lightwell
