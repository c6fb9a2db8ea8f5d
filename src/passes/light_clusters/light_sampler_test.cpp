#include "passes/light_clusters/light_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "core/luminance.h"
#include "graph/testing/graph_test.h"
#include "passes/light_clusters/testing/light_points.h"

namespace lightwell {
namespace {

constexpr Bounds kBounds{glm::vec3(-2.0f), glm::vec3(2.0f)};
constexpr std::uint32_t kSide = 40;  // receivers: two and a half tiles a side
constexpr float kLeastDistance = 0.2f;
const LightClamp kClamp{.nearest = kLeastDistance, .farthest = kLeastDistance};

class LightSamplerTest : public GraphTest {
 protected:
  // Receivers on a bent floor, some missing.
  void SetUp() override {
    GraphTest::SetUp();
    for (std::uint32_t y = 0; y < kSide; ++y)
      for (std::uint32_t x = 0; x < kSide; ++x) {
        const glm::vec2 place = glm::vec2(x, y) / static_cast<float>(kSide - 1) * 3.0f - 1.5f;
        positions_.push_back({place.x, -1.0f + 0.1f * place.x * place.x, place.y, x == 7 ? 0.0f : 1.0f});
        normals_.push_back(glm::normalize(glm::vec3(-0.2f * place.x, 1.0f, 0.0f)));
      }
  }

  Receivers upload_receivers(FrameGraph& graph) {
    std::vector<std::uint64_t> halves;
    for (const glm::vec3& n : normals_) halves.push_back(glm::packHalf4x16(glm::vec4(n, 0.0f)));
    Receivers receivers{
        graph.create_image("position", {.width = kSide, .height = kSide, .format = VK_FORMAT_R32G32B32A32_SFLOAT}),
        graph.create_image("normal", {.width = kSide, .height = kSide, .format = VK_FORMAT_R16G16B16A16_SFLOAT}),
        {},
        kSide,
        kSide};
    graph.copy("upload", graph.upload<glm::vec4>("positions", positions_), receivers.position);
    graph.copy("upload", graph.upload<std::uint64_t>("normals", halves), receivers.normal);
    return receivers;
  }

  // Luminance of the light of a point, as the sampler sees it.
  static double light_of(const glm::vec3& position, const glm::vec3& normal, const glsl::LightPoint& point) {
    const glm::dvec3 offset = glm::dvec3(point.position) - glm::dvec3(position);
    const double squared = glm::dot(offset, offset);
    const glm::dvec3 direction = offset / std::sqrt(squared);
    const double cosine = std::max(0.0, glm::dot(glm::dvec3(normal), direction));
    const double cosine_there = std::max(0.0, -glm::dot(glm::dvec3(unpack_unit_vector(point.normal)), direction));
    return luminance(glm::dvec3(point.flux)) * cosine * cosine_there /
           std::max(double{kLeastDistance} * kLeastDistance, squared);
  }

  // Mean over frames of the estimates of every receiver's light, and how often each point was chosen in all.
  struct Result {
    std::vector<double> mean;
    std::vector<double> variance;  // of the mean
    std::vector<double> chosen;    // by the point's number
  };
  Result sample(const std::vector<glsl::LightPoint>& points, std::uint32_t frames, LightChoiceSettings settings,
                bool blocked = false) {
    Result result;
    std::vector<double> squares(positions_.size());
    result.mean.resize(positions_.size());
    result.chosen.resize(points.size());
    settings.clamp = kClamp;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      settings.first_sample = frame * settings.rays;
      FrameGraph graph(executor().context());
      const Receivers receivers = upload_receivers(graph);
      const LightClusters clusters = record_light_clusters(graph, graph.upload<glsl::LightPoint>("points", points),
                                                           static_cast<std::uint32_t>(points.size()), kBounds);
      LearnedVisibility learned{graph.create_buffer("learned", std::uint64_t{glsl::kLearnedSlots} * glsl::kLearnedWords,
                                                    sizeof(std::uint32_t))};
      // Slots that know of many rays, all blocked: sampling must not trust them altogether.
      graph.fill("learned", learned.table, 0);
      if (blocked) {
        std::vector<std::uint32_t> words(std::size_t{glsl::kLearnedSlots} * glsl::kLearnedWords);
        std::mt19937 random(1);
        for (std::size_t i = 0; i < words.size(); i += glsl::kLearnedWords)
          if (random() % 2 == 0) words[i + glsl::kLearnedRays] = 1u << 20;
        graph.copy("learned", graph.upload<std::uint32_t>("words", words), learned.table,
                   words.size() * sizeof(std::uint32_t));
      }
      const LightTiles tiles = record_light_tiles(graph, receivers, clusters, learned, kClamp, kBounds);
      const ReadbackTicket ticket = graph.read_back(record_light_choice(graph, receivers, clusters, tiles, settings));
      run(graph);
      const auto choices = fetch<glm::uvec4>(ticket);
      for (std::size_t i = 0; i < positions_.size(); ++i) {
        double estimate = 0.0;
        for (std::uint32_t ray = 0; ray < settings.rays; ++ray) {
          const glm::uvec4 choice = choices[ray * positions_.size() + i];
          if (choice.x == glsl::kNoChoice) continue;
          float weight = 0.0f;
          std::memcpy(&weight, &choice.y, sizeof(weight));
          EXPECT_LE(points[choice.w].bounces, settings.most_bounces);
          result.chosen[choice.w] += 1.0;
          estimate += weight * light_of(positions_[i], normals_[i], points[choice.w]);
        }
        result.mean[i] += estimate / frames;
        squares[i] += estimate * estimate / frames;
      }
    }
    for (std::size_t i = 0; i < squares.size(); ++i)
      result.variance.push_back(std::max(0.0, squares[i] - result.mean[i] * result.mean[i]) / frames);
    return result;
  }

  // All estimates together and each by itself are the sum over all points.
  void expect_right(const std::vector<glsl::LightPoint>& points, const Result& result, std::uint32_t most_bounces) {
    double sum = 0.0, expected_sum = 0.0, off = 0.0, lit = 0.0;
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      double expected = 0.0;
      for (const glsl::LightPoint& point : points)
        if (point.bounces <= most_bounces) expected += light_of(positions_[i], normals_[i], point);
      if (positions_[i].w == 0.0f) expected = 0.0;
      sum += result.mean[i];
      expected_sum += expected;
      if (expected == 0.0) {
        EXPECT_EQ(result.mean[i], 0.0);
        continue;
      }
      lit += 1.0;
      const double error = result.mean[i] - expected;
      off += error * error > 16.0 * result.variance[i] + 1e-6 * expected * expected ? 1.0 : 0.0;
    }
    EXPECT_NEAR(sum / expected_sum, 1.0, 0.005);
    EXPECT_LE(off / lit, 0.01);
  }

  std::vector<glm::vec4> positions_;
  std::vector<glm::vec3> normals_;
};

TEST_F(LightSamplerTest, IsRightInTheMean) {
  const auto points = random_light_points(2000, kBounds, 17);
  expect_right(points, sample(points, 48, {.candidates = 8}), 64);
  expect_right(points, sample(points, 24, {.candidates = 1, .rays = 4}), 64);
  expect_right(points, sample(points, 48, {.candidates = 8, .most_bounces = 2}), 2);
}

TEST_F(LightSamplerTest, IsRightInTheMeanWhateverWasLearned) {
  const auto points = random_light_points(2000, kBounds, 18);
  // Skewed: 4 standard deviations, as estimated from the frames, are passed more often.
  expect_right(points, sample(points, 512, {.candidates = 8}, true), 64);
}

TEST_F(LightSamplerTest, MoreCandidatesLeaveLessNoise) {
  const auto points = random_light_points(2000, kBounds, 19);
  const auto noise = [&](std::uint32_t candidates) {
    double sum = 0.0;
    for (const double variance : sample(points, 16, {.candidates = candidates}).variance) sum += variance;
    return sum;
  };
  EXPECT_LT(noise(16), 0.5 * noise(1));
}

TEST_F(LightSamplerTest, WithoutLightNothingIsChosen) {
  std::vector<glsl::LightPoint> points = random_light_points(100, kBounds, 20);
  for (glsl::LightPoint& point : points) point.flux = glm::vec3(0.0f);
  const Result result = sample(points, 1, {});
  for (const double count : result.chosen) EXPECT_EQ(count, 0.0);
}

}  // namespace
}  // namespace lightwell
