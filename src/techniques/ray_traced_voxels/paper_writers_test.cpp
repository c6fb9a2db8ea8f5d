// What each writer leaves of the same hits.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>

#include "techniques/ray_traced_voxels/paper_replay.h"
#include "techniques/ray_traced_voxels/paper_test_frame.h"

namespace lightwell {
namespace {

class PaperWriters : public PaperStagesTest {
 protected:
  // Hits made on the host.
  HitReplay replay_of(const std::vector<glsl::VoxelHit>& hits, std::uint32_t cell_count, float range) {
    return {device(), static_cast<std::uint32_t>(hits.size()), cell_count, range,
            [hits](FrameGraph& graph) { return graph.upload<glsl::VoxelHit>("hits", hits); }};
  }

  static std::vector<glsl::VoxelHit> random_hits(std::uint32_t count, std::uint32_t cells, std::uint32_t seed) {
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    std::vector<glsl::VoxelHit> hits(count);
    for (glsl::VoxelHit& hit : hits) {
      hit.irradiance = {uniform(random), uniform(random), uniform(random)};
      hit.voxel = random() % 8 == 0 ? glsl::kNoVoxel : random() % cells;
    }
    return hits;
  }

  struct Mean {
    glm::dvec3 sum{0.0};
    double count = 0.0;
  };
  static std::vector<Mean> means_of(const std::vector<glsl::VoxelHit>& hits, std::uint32_t cells) {
    std::vector<Mean> means(cells);
    for (const glsl::VoxelHit& hit : hits) {
      if (hit.voxel == glsl::kNoVoxel) continue;
      means[hit.voxel].sum += glm::dvec3(hit.irradiance);
      means[hit.voxel].count += 1.0;
    }
    return means;
  }

  // The worst relative error of voxels above 1e-4 of the largest mean.
  static double worst_error(const std::vector<Mean>& means, const std::vector<std::uint32_t>& floats) {
    double largest = 0.0;
    for (const Mean& mean : means)
      if (mean.count > 0.0) largest = std::max(largest, mean.sum.x / mean.count);
    double worst = 0.0;
    for (std::size_t i = 0; i < means.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const double truth = means[i].count > 0.0 ? means[i].sum[k] / means[i].count : 0.0;
        const double value = std::bit_cast<float>(floats[3 * i + static_cast<std::size_t>(k)]);
        EXPECT_TRUE(truth != 0.0 || value == 0.0);
        if (truth > 1e-4 * largest) worst = std::max(worst, std::abs(value / truth - 1.0));
      }
    }
    return worst;
  }
};

constexpr std::uint32_t kCells = 512;

std::uint32_t pack_sample(const glm::vec3& value) {
  return glm::packUnorm4x8(glm::vec4(value, 1.0f / 255.0f));
}

TEST_F(PaperWriters, MaximumIsThatOfThePackedWords) {
  const auto hits = random_hits(4096, kCells, 1);
  std::vector<std::uint32_t> expected(kCells, 0);
  for (const auto& hit : hits)
    if (hit.voxel != glsl::kNoVoxel) expected[hit.voxel] = std::max(expected[hit.voxel], pack_sample(hit.irradiance));
  EXPECT_EQ(replay_of(hits, kCells, 1.0f).write(VoxelWriter::kMaximum), expected);
}

TEST_F(PaperWriters, NoneLeavesOneOfTheSamples) {
  const auto hits = random_hits(4096, kCells, 2);
  const auto words = replay_of(hits, kCells, 1.0f).write(VoxelWriter::kNone);
  std::vector<bool> found(kCells, false);
  std::vector<bool> hit_at_all(kCells, false);
  for (const auto& hit : hits) {
    if (hit.voxel == glsl::kNoVoxel) continue;
    hit_at_all[hit.voxel] = true;
    found[hit.voxel] = found[hit.voxel] || words[hit.voxel] == pack_sample(hit.irradiance);
  }
  EXPECT_EQ(found, hit_at_all);
}

// Few samples: near the mean, with the right count. Equal samples: exactly they. Many: the count stays at 255.
TEST_F(PaperWriters, AverageMovesToTheMean) {
  const auto hits = random_hits(4096, kCells, 3);
  const auto words = replay_of(hits, kCells, 1.0f).write(VoxelWriter::kAverage);
  const auto means = means_of(hits, kCells);
  double worst = 0.0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    EXPECT_EQ(words[i] >> 24, static_cast<std::uint32_t>(means[i].count));
    if (means[i].count > 0.0) worst = std::max(worst, std::abs(unpack(words[i]).r - means[i].sum.r / means[i].count));
  }
  std::printf("moving average of %u samples a voxel: off by %.4f at most\n", 4096 / kCells, worst);
  EXPECT_LT(worst, 8.0 * 0.5 / 255.0);

  std::vector<glsl::VoxelHit> equal(1024, {{0.2f, 0.4f, 0.6f}, 7});
  EXPECT_EQ(replay_of(equal, kCells, 1.0f).write(VoxelWriter::kAverage)[7],
            glm::packUnorm4x8({0.2f, 0.4f, 0.6f, 1.0f}));
}

TEST_F(PaperWriters, ExactIsTheMean) {
  const auto hits = random_hits(65536, kCells, 4);
  HitReplay replay = replay_of(hits, kCells, 1.0f);
  const auto floats = replay.write(VoxelWriter::kExact);
  EXPECT_LT(worst_error(means_of(hits, kCells), floats), 1e-5);
  EXPECT_EQ(replay.write(VoxelWriter::kExact), floats);  // and the sums were 0 again
}

TEST_F(PaperWriters, ExactDoesNotDependOnOrder) {
  // Within a run samples are added as floats: whole runs change places.
  auto hits = random_hits(4096, 40, 5);
  const auto floats = replay_of(hits, kCells, 1.0f).write(VoxelWriter::kExact);
  std::vector<std::uint32_t> runs(hits.size() / glsl::kExactRun);
  for (std::uint32_t i = 0; i < runs.size(); ++i) runs[i] = i;
  std::shuffle(runs.begin(), runs.end(), std::mt19937(6));
  std::vector<glsl::VoxelHit> shuffled;
  for (const std::uint32_t run : runs)
    shuffled.insert(shuffled.end(), hits.begin() + run * glsl::kExactRun, hits.begin() + (run + 1) * glsl::kExactRun);
  EXPECT_EQ(replay_of(shuffled, kCells, 1.0f).write(VoxelWriter::kExact), floats);
}

TEST_F(PaperWriters, ExactIsTheSameInPages) {
  constexpr std::uint32_t kMore = 4096;
  auto hits = random_hits(1024, kMore, 8);
  for (auto& hit : hits) hit.irradiance *= 1000.0f;  // high words, too
  const auto floats = replay_of(hits, kMore, 1.0f).write(VoxelWriter::kExact);
  HitReplay paged = replay_of(hits, kMore, 1.0f);
  paged.limit_descriptor_range(16384);  // four pages of low words
  EXPECT_EQ(paged.write(VoxelWriter::kExact), floats);
  EXPECT_EQ(paged.write(VoxelWriter::kExact), floats);
}

// Beyond 32 bits, far above the range and far below; nothing saturates.
TEST_F(PaperWriters, ExactCarries) {
  auto hits = random_hits(65536, kCells, 7);
  for (auto& hit : hits)
    if (hit.voxel != glsl::kNoVoxel) hit.irradiance *= std::ldexp(1.0f, static_cast<int>(hit.voxel % 26) - 13);
  const auto means = means_of(hits, kCells);
  const auto floats = replay_of(hits, kCells, 1.0f).write(VoxelWriter::kExact);
  double worst = 0.0;
  for (std::size_t i = 0; i < means.size(); ++i)
    worst = std::max(worst, std::abs(std::bit_cast<float>(floats[3 * i]) / (means[i].sum.x / means[i].count) - 1.0));
  EXPECT_LT(worst, 1e-4);

  std::vector<glsl::VoxelHit> many(1u << 18, {{8191.0f, 1.0f, 1e-4f}, 3});
  const auto one = replay_of(many, kCells, 1.0f).write(VoxelWriter::kExact);
  EXPECT_NEAR(std::bit_cast<float>(one[9]) / 8191.0f, 1.0f, 1e-6f);
  EXPECT_NEAR(std::bit_cast<float>(one[10]), 1.0f, 1e-6f);
  EXPECT_NEAR(std::bit_cast<float>(one[11]) / 1e-4f, 1.0f, 1e-4f);
}

TEST_F(PaperWriters, ExactTakesWhatIsNotANumberForNothing) {
  std::vector<glsl::VoxelHit> hits(64, {{1.0f, 1.0f, 1.0f}, 1});
  for (std::size_t i = 0; i < 32; ++i) hits[i].irradiance = glm::vec3(NAN, -1.0f, INFINITY);
  const auto floats = replay_of(hits, kCells, 1.0f).write(VoxelWriter::kExact);
  EXPECT_NEAR(std::bit_cast<float>(floats[3]), 0.5f, 1e-6f);
  for (std::size_t k = 3; k < 6; ++k) EXPECT_TRUE(std::isfinite(std::bit_cast<float>(floats[k])));
}

// Traced hits of a light in the middle and one close to the floor, replayed.
TEST_F(PaperWriters, RecordedHits) {
  for (const float height : {1.0f, 0.05f}) {
    load(make_room().scene,
         {make_light(LightType::kSpot, {0.1f, height, 0.2f}, {0, -1, 0}, glm::vec3(height * height))});
    const VoxelGrid cells = grid(64);
    std::optional<WorldFrame> world;
    HitReplay replay(device(), paper_hit_count(512), cells.cell_count, 1.0f, [&](FrameGraph& graph) {
      world.emplace(graph, *world_, snapshot_, 0.0);
      ExactSums none;
      const PaperMaterials materials = record_paper_materials(graph, world->scene, cells, VoxelWriter::kMaximum, none);
      return record_light_hits(graph, *world, materials, {.side = 512}, 0);
    });
    const auto means = means_of(replay.hits(), cells.cell_count);
    const double exact = worst_error(means, replay.write(VoxelWriter::kExact));
    EXPECT_LT(exact, 1e-4);
    const auto average = replay.write(VoxelWriter::kAverage);
    double off = 0.0;
    double sum = 0.0;
    double lit = 0.0;
    for (std::size_t i = 0; i < means.size(); ++i) {
      if (means[i].count == 0.0) continue;
      const double error = std::abs(unpack(average[i]).r - std::min(means[i].sum.r / means[i].count, 1.0));
      off = std::max(off, error);
      sum += error;
      lit += 1.0;
    }
    std::printf(
        "light %.2f m above the floor: exact off by %.1e of itself at most, moving average by %.4f of the range "
        "at most, %.4f on average, %g voxels\n",
        static_cast<double>(height), exact, off, sum / lit, lit);
  }
}

}  // namespace
}  // namespace lightwell
