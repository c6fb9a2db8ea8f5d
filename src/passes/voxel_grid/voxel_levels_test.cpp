// Nested levels: their windows, and the functions of C++ and GLSL against each other and the definition.
#include "passes/voxel_grid/voxel_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "graph/linear_dispatch.h"
#include "graph/testing/graph_test.h"
#include "kernels/passes/voxel_grid/testing/level_functions.comp.h"
#include "passes/voxel_grid/testing/level_functions.h"
#include "passes/voxel_grid/testing/level_oracle.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 41;
constexpr Bounds kUnit{glm::vec3(0.0f), glm::vec3(1.0f)};

class Random {
 public:
  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
  std::uint32_t below(std::uint32_t end) { return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(engine_); }
  glm::vec3 vector(float low, float high) { return {between(low, high), between(low, high), between(low, high)}; }

 private:
  std::mt19937 engine_{kSeed};
};

// About any place in bounds of any size, now and then outside of them.
VoxelLevels random_levels(Random& random) {
  constexpr std::uint32_t kResolutions[] = {8, 16, 17, 31, 32, 64, 128};
  const float extent = std::exp2(random.between(-6.0f, 12.0f));
  const glm::vec3 corner = random.vector(-2.0f, 2.0f) * extent;
  const Bounds bounds{corner, corner + extent * random.vector(0.1f, 1.0f)};
  const glm::vec3 focus = bounds.minimum + (bounds.maximum - bounds.minimum) * random.vector(-0.3f, 1.3f);
  const std::uint32_t resolution = kResolutions[random.below(7)];
  const float finest = extent / static_cast<float>(resolution) * std::exp2(-random.between(0.0f, 8.0f));
  return keep_voxel_levels({}, bounds, focus, {resolution, finest});
}

VoxelLevels about(VoxelLevels levels, const glm::ivec3& center) {
  levels.center = center;
  return levels;
}

TEST(VoxelLevels, ASmallSceneHasOneGrid) {
  const VoxelGrid grid = fit_voxel_grid(kUnit, 32);
  for (const float finest : {0.0f, 0.5f * grid.cell_size, 1.0f, NAN}) {
    const VoxelLevels levels = keep_voxel_levels({}, kUnit, glm::vec3(0.9f), {32, finest});
    EXPECT_EQ(levels.count, 1u) << finest;
    EXPECT_TRUE(is_same_grid(level_grid(levels, 0), grid));
    EXPECT_EQ(count_cells(levels), grid.cell_count);
  }
}

TEST(VoxelLevels, LevelsAreAddedUntilCellsAreFineEnough) {
  for (std::uint32_t wanted = 3; wanted <= 12; ++wanted) {
    const float coarsest = fit_voxel_grid(kUnit, 32).cell_size;
    const float finest = 1.01f * std::ldexp(coarsest, 1 - static_cast<int>(wanted));
    const VoxelLevels levels = keep_voxel_levels({}, kUnit, glm::vec3(0.5f), {32, finest});
    EXPECT_EQ(levels.count, wanted);
    EXPECT_LE(levels.cell_size, finest);
    EXPECT_FLOAT_EQ(level_grid(levels, levels.count - 1).cell_size, coarsest);
  }
}

TEST(VoxelLevels, NoMoreThanCanBeNumbered) {
  for (const std::uint32_t resolution : {1u, 8u, 16u, 64u, 128u, 256u}) {
    const VoxelLevels levels = keep_voxel_levels({}, kUnit, glm::vec3(0.5f), {resolution, 1e-12f});
    EXPECT_LE(count_cells(levels), kMostLevelCells);
    EXPECT_LE(levels.count, kMostLevels);
    EXPECT_EQ(levels.count > 1, resolution >= 16 && resolution < 256) << resolution;
  }
}

TEST(VoxelLevels, CellsStayWhereTheyAreWhileTheFocusMoves) {
  Random random;
  const VoxelLevels first = keep_voxel_levels({}, kUnit, glm::vec3(0.5f), {32, 1e-3f});
  VoxelLevels last = first;
  for (int step = 0; step < 100; ++step) {
    last = keep_voxel_levels(last, kUnit, random.vector(-0.2f, 1.2f), {32, 1e-3f});
    EXPECT_TRUE(are_same_cells(last, first));
  }
  EXPECT_FALSE(are_same_cells(keep_voxel_levels(last, kUnit, glm::vec3(0.5f), {32, 1e-2f}), first));
}

TEST(VoxelLevels, EachWindowLiesInTheNextCoarserOneAboutTheFocus) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Random random;
  std::uint32_t most = 0;
  for (int i = 0; i < 2000; ++i) {
    const VoxelLevels levels = random_levels(random);
    most = std::max(most, levels.count);
    const auto side = static_cast<int>(levels.resolution);
    EXPECT_EQ(level_lower(levels, levels.count - 1), glm::ivec3(0));
    for (std::uint32_t level = 0; level < levels.count; ++level) {
      const glm::ivec3 lower = level_lower(levels, level);
      for (int axis = 0; axis < 3; ++axis) {
        const int center = levels.center[axis] >> level;
        EXPECT_TRUE(lower[axis] <= center && center < lower[axis] + side);
        const int last = (side << (levels.count - 1 - level)) - side;
        EXPECT_TRUE(lower[axis] % glsl::kLevelSnap == 0 || lower[axis] == last);
        if (level + 1 == levels.count) continue;
        const int outer = level_lower(levels, level + 1)[axis];
        EXPECT_TRUE(2 * outer <= lower[axis] && lower[axis] + side <= 2 * (outer + side));
      }
    }
  }
  EXPECT_GE(most, 8u);
}

// Else some frames of a flight would voxelise all levels' slabs, and most none.
TEST(VoxelLevels, OneWindowMovesAtATime) {
  VoxelLevels levels = keep_voxel_levels({}, kUnit, glm::vec3(0.0f), {32, 1e-3f});
  std::vector<int> moves(levels.count);
  for (levels.center.x = 1; levels.center.x < static_cast<int>(32u << (levels.count - 1)); ++levels.center.x) {
    VoxelLevels last = levels;
    --last.center.x;
    int moved = 0;
    for (std::uint32_t level = 0; level < levels.count; ++level) {
      const bool moves_on = level_lower(levels, level) != level_lower(last, level);
      moved += moves_on ? 1 : 0;
      moves[level] += moves_on ? 1 : 0;
    }
    EXPECT_LE(moved, 1);
  }
  for (std::uint32_t level = 0; level + 1 < levels.count; ++level) EXPECT_GE(moves[level], 8);
}

class LevelFunctionsTest : public GraphTest {
 protected:
  std::vector<glsl::LevelAnswer> ask(const std::vector<glsl::LevelQuestion>& questions) {
    const auto count = static_cast<std::uint32_t>(questions.size());
    FrameGraph graph(executor().context());
    BufferHandle answers = graph.create_buffer("answers", count, sizeof(glsl::LevelAnswer));
    dispatch_linear(graph.compute("level functions", kernels::voxel_grid_testing_level_functions_comp)
                        .read("questions", graph.upload<glsl::LevelQuestion>("questions", questions))
                        .write("answers", answers)
                        .push(glsl::LevelFunctionsParams{count}),
                    count);
    const ReadbackTicket ticket = graph.read_back(answers);
    run(graph);
    return fetch<glsl::LevelAnswer>(ticket);
  }
};

TEST_F(LevelFunctionsTest, CellsAndTheirPlacesInBuffers) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Random random;
  std::vector<glsl::LevelQuestion> questions;
  for (int i = 0; i < 500; ++i) {
    const VoxelLevels levels = random_levels(random);
    const auto cells = static_cast<int>(levels.resolution << (levels.count - 1));
    // Last frame's levels lay near, or anywhere.
    const float reach = i % 2 == 0 ? 1.5f * static_cast<float>(levels.resolution) : static_cast<float>(cells);
    const glm::ivec3 old = glm::clamp(levels.center + glm::ivec3(random.vector(-reach, reach)), 0, cells - 1);
    for (int k = 0; k < 40; ++k)
      questions.push_back({.levels = levels, .old_center = old, .index = random.below(count_cells(levels))});
  }
  const std::vector<glsl::LevelAnswer> answers = ask(questions);
  std::size_t same = 0;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const glsl::LevelQuestion& question = questions[i];
    const glsl::LevelAnswer& answer = answers[i];
    const LevelCell cell = cell_of_index(question.levels, question.index);
    const glm::ivec3 lower = level_lower(question.levels, cell.level);
    ASSERT_EQ(answer.level, cell.level) << i;
    ASSERT_EQ(answer.lower, lower) << i;
    ASSERT_EQ(answer.cell + lower, glm::ivec3(cell.x, cell.y, cell.z)) << i;
    ASSERT_EQ(answer.index, question.index) << i;
    ASSERT_EQ(index_of_cell(question.levels, cell), question.index) << i;
    ASSERT_EQ(answer.is_same != 0, shows(about(question.levels, question.old_center), cell)) << i;
    same += answer.is_same;
    const VoxelGrid grid = level_grid(question.levels, cell.level);
    ASSERT_EQ(answer.cell_size, grid.cell_size) << i;
    for (int axis = 0; axis < 3; ++axis) ASSERT_NEAR(answer.origin[axis], grid.origin[axis], 1e-3f * grid.cell_size);
  }
  EXPECT_GT(same, questions.size() / 4);
  EXPECT_LT(same, 3 * questions.size() / 4);
}

// Pairs of positions in a level, near its edge or anywhere.
TEST_F(LevelFunctionsTest, LevelsFadeBeforeTheirWindowsEnd) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Random random;
  std::vector<glsl::LevelQuestion> questions;
  for (int i = 0; i < 20000; ++i) {
    const VoxelLevels levels = random_levels(random);
    const std::uint32_t index = random.below(count_cells(levels));
    const VoxelGrid grid = level_grid(levels, cell_of_index(levels, index).level);
    const VoxelGrid all = level_grid(levels, levels.count - 1);
    const float half = 0.5f * static_cast<float>(levels.resolution) * grid.cell_size;
    const auto inside = [&](const glm::vec3& p) { return glm::clamp(p, all.origin, upper_corner(all)); };
    const glm::vec3 first = inside(levels.focus + 1.2f * half * random.vector(-1.0f, 1.0f));
    const glm::vec3 second = inside(first + grid.cell_size * random.between(0.0f, 4.0f) * random.vector(-1.0f, 1.0f));
    for (const glm::vec3& position : {first, second})
      questions.push_back({.levels = levels, .index = index, .position = position});
  }
  const std::vector<glsl::LevelAnswer> answers = ask(questions);
  std::size_t between = 0, outside = 0;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const VoxelLevels& levels = questions[i].levels;
    const float weight = answers[i].weight;
    ASSERT_TRUE(weight >= 0.0f && weight <= 1.0f) << i;
    const VoxelGrid grid = level_grid(levels, answers[i].level);
    const glm::vec3 position = questions[i].position;
    const bool is_coarsest = answers[i].level + 1 == levels.count;
    if (is_coarsest) {
      ASSERT_EQ(weight, 1.0f) << i;
    }
    const glm::vec3 coordinates = (position - grid.origin) / grid.cell_size;
    constexpr float kRounding = 0.02f;
    const bool is_outside = glm::any(glm::lessThan(coordinates, glm::vec3(-kRounding))) ||
                            glm::any(glm::greaterThan(coordinates, glm::vec3(grid.resolution) + kRounding));
    if (is_outside && !is_coarsest) {
      ++outside;
      ASSERT_EQ(weight, 0.0f) << i;
    }
    between += weight > 0.0f && weight < 1.0f ? 1 : 0;
    if (i % 2 == 0) continue;
    const glm::vec3 step = glm::abs(position - questions[i - 1].position) / grid.cell_size;
    const float fade = std::max(static_cast<float>(levels.resolution) / 16.0f, 1.0f);
    ASSERT_LE(std::abs(weight - answers[i - 1].weight), std::max({step.x, step.y, step.z}) / fade + 1e-2f) << i;
  }
  EXPECT_GT(between, 1000u);
  EXPECT_GT(outside, 1000u);
}

TEST_F(LevelFunctionsTest, TheFinestLevelIsChosenByPlaceAndFootprint) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Random random;
  std::vector<glsl::LevelQuestion> questions;
  for (int i = 0; i < 300; ++i) {
    const VoxelLevels levels = random_levels(random);
    const VoxelGrid all = level_grid(levels, levels.count - 1);
    const std::uint32_t cells = count_cells(levels) / levels.count;
    const glm::vec3 position = all.origin + (upper_corner(all) - all.origin) * random.vector(0.0f, 1.0f);
    const float footprint = i % 3 == 0 ? 0.0f : levels.cell_size * std::exp2(random.between(-1.0f, 9.0f));
    for (std::uint32_t level = 0; level < levels.count; ++level)
      questions.push_back({.levels = levels,
                           .index = (levels.count - 1 - level) * cells,
                           .position = position,
                           .footprint = footprint});
  }
  const std::vector<glsl::LevelAnswer> answers = ask(questions);
  for (std::size_t first = 0; first < questions.size();) {
    const VoxelLevels& levels = questions[first].levels;
    std::uint32_t expected = 0;
    while (expected + 1 < levels.count && (answers[first + expected].weight == 0.0f ||
                                           answers[first + expected].cell_size < questions[first].footprint))
      ++expected;
    for (std::uint32_t level = 0; level < levels.count; ++level)
      ASSERT_EQ(answers[first + level].level_at, expected) << first;
    first += levels.count;
  }
}

}  // namespace
}  // namespace lightwell
