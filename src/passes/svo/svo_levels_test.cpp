// The octree over nested levels: their windows, the tree against the bits of all levels, and rays against exact ones.
#include "passes/svo/svo_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include <glm/geometric.hpp>

#include "passes/svo/testing/level_tree_oracle.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 29;

class Random {
 public:
  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
  glm::vec3 vector(float low, float high) { return {between(low, high), between(low, high), between(low, high)}; }

 private:
  std::mt19937 engine_{kSeed};
};

// So many levels over the unit cube.
SvoSettings settings_of(std::uint32_t resolution, int level_count, const glm::vec3& focus) {
  const float coarsest = fit_voxel_grid(kUnit, resolution).cell_size;
  return {.resolution = resolution,
          .epsilon = 0.0f,
          .finest_cell = 1.01f * std::ldexp(coarsest, 1 - level_count),
          .focus = focus};
}

// Of all sizes, in each level's window as many.
std::vector<Corners> triangles_of_levels(const SvoSettings& settings, int count) {
  const SvoLevels levels = keep_svo_levels(nullptr, kUnit, settings.focus, settings.resolution, settings.finest_cell);
  std::vector<Corners> triangles;
  for (std::uint32_t level = 0; level < levels.levels.count; ++level)
    for (const Corners& corners : random_triangles(level_grid(levels, level), kSeed + level, count))
      triangles.push_back(corners);
  return triangles;
}

TEST(SvoLevels, OneGridIsFittedToTheScene) {
  const Bounds bounds{{-1.0f, 0.5f, 2.0f}, {3.0f, 2.0f, 2.5f}};
  for (const float finest : {0.0f, 0.1f, 1.0f}) {
    const SvoLevels levels = keep_svo_levels(nullptr, bounds, glm::vec3(0.3f), 32, finest);
    EXPECT_EQ(levels.levels.count, 1u) << finest;
    EXPECT_TRUE(is_same_grid(level_grid(levels, 0), fit_voxel_grid(bounds, 32)));
    EXPECT_EQ(center_corner(levels), fit_voxel_grid(bounds, 32).origin);
  }
}

TEST(SvoLevels, WindowsHoldTheFocusAndOneAnother) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Random random;
  std::uint32_t most = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::uint32_t resolution = 32u << (i % 5);
    const float extent = std::exp2(random.between(-3.0f, 12.0f));
    const Bounds bounds{-extent * random.vector(0.1f, 1.0f), extent * random.vector(0.1f, 1.0f)};
    const float finest = extent / static_cast<float>(resolution) * std::exp2(-random.between(0.0f, 7.0f));
    const auto side = static_cast<int>(resolution);
    std::optional<SvoLevels> last;
    for (int step = 0; step < 3; ++step) {
      const SvoLevels levels =
          keep_svo_levels(last ? &*last : nullptr, bounds, extent * random.vector(-1.2f, 1.2f), resolution, finest);
      most = std::max(most, levels.levels.count);
      EXPECT_EQ(levels.lower[levels.levels.count - 1], glm::ivec3(0));
      for (std::uint32_t level = 0; level + 1 < levels.levels.count; ++level) {
        EXPECT_TRUE(in_window(levels, level, levels.levels.center));
        for (int axis = 0; axis < 3; ++axis) {
          const int lower = levels.lower[level][axis], outer = levels.lower[level + 1][axis];
          EXPECT_EQ(lower % kSvoSnap, 0);
          EXPECT_TRUE(2 * outer <= lower && lower + side <= 2 * (outer + side));
        }
      }
      last = levels;
    }
  }
  EXPECT_GE(most, 7u);
}

TEST(SvoLevels, WindowsRestWhileTheFocusMovesLittle) {
  const SvoSettings s = settings_of(256, 4, glm::vec3(0.4f));
  const SvoLevels first = keep_svo_levels(nullptr, kUnit, s.focus, 256, s.finest_cell);
  const float cell = first.levels.cell_size;
  SvoLevels last = first;
  for (const float cells : {10.0f, -10.0f, 20.0f, 0.0f}) {
    last = keep_svo_levels(&last, kUnit, s.focus + cells * cell, 256, s.finest_cell);
    EXPECT_TRUE(is_same(last, first));
  }
  EXPECT_FALSE(is_same(keep_svo_levels(&last, kUnit, s.focus + 50.0f * cell, 256, s.finest_cell), first));
}

using SvoLevelsTest = SvoTest;

TEST_F(SvoLevelsTest, TheTreeHoldsTheFinestLevelOfEachPlace) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const glm::vec3 places[] = {glm::vec3(0.5f), {0.02f, 0.7f, 0.99f}, {0.31f, 0.26f, 0.6f}};
  for (const std::uint32_t resolution : {16u, 32u, 64u}) {
    for (const int count : {3, 5}) {
      const SvoSettings s =
          settings_of(resolution, count, places[(resolution / 16 + static_cast<std::uint32_t>(count) / 2) % 3]);
      const BuiltSvo built = build(triangles_of_levels(s, 40), kUnit, s);
      ASSERT_EQ(built.svo.memory.level_count, static_cast<std::uint32_t>(count));
      ASSERT_EQ(built.reached(), built.level() + built.svo.memory.level_count - 1);
      expect_tree_of_levels(built);
    }
  }
}

// Whatever room there is, the tree is right; where it is little, coarser.
TEST_F(SvoLevelsTest, LittleMemoryMakesACoarserTree) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  SvoSettings s = settings_of(64, 4, {0.31f, 0.26f, 0.6f});
  std::vector<Corners> triangles = triangles_of_levels(s, 150);
  const VoxelGrid finest = level_grid(keep_svo_levels(nullptr, kUnit, s.focus, s.resolution, s.finest_cell), 0);
  for (int i = 0; i < 64; ++i) {  // a block in the finest window: many cells a tile
    const float z = finest.origin.z + (static_cast<float>(i) + 0.5f) * finest.cell_size;
    triangles.push_back({glm::vec3(0.0f, 0.0f, z), glm::vec3(2.0f, 0.0f, z), glm::vec3(0.0f, 2.0f, z)});
  }
  std::set<std::uint32_t> reached, list_levels;
  for (const std::uint64_t kib : {32768, 6000, 4000, 2000, 1000, 600, 400}) {
    SCOPED_TRACE(std::to_string(kib) + " KiB");
    s.budget = kib << 10;
    const BuiltSvo built = build(triangles, kUnit, s);
    EXPECT_LE(built.svo.memory.bytes, s.budget);
    EXPECT_LE(built.counts[glsl::kSvoNodesUsed], 8 * built.svo.memory.node_tiles);
    expect_tree_of_levels(built);
    reached.insert(built.reached());
    list_levels.insert(built.counts[glsl::kSvoListLevel] + 6 - built.level());
  }
  EXPECT_GE(reached.size(), 3u);
  EXPECT_GE(list_levels.size(), 3u);
}

// Of a segment and the boxes of leaves, in finest cells, grown on every side.
bool is_blocked(const std::set<TreeBox>& leaves, const glm::dvec3& from, const glm::dvec3& to, double growth) {
  const glm::dvec3 d = to - from;
  for (const TreeBox& leaf : leaves) {
    const double side = std::ldexp(1.0, static_cast<int>(leaf.shift));
    double enter = 0.0, leave = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = leaf.cell[axis] * side - growth, high = low + side + 2.0 * growth;
      if (d[axis] == 0.0) {
        if (from[axis] < low || from[axis] > high) leave = -1.0;
        continue;
      }
      const double a = (low - from[axis]) / d[axis], b = (high - from[axis]) / d[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter <= leave) return true;
  }
  return false;
}

bool meets_triangle(const Corners& corners, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 a(corners[0]), e1 = glm::dvec3(corners[1]) - a, e2 = glm::dvec3(corners[2]) - a, d = to - from;
  const glm::dvec3 p = glm::cross(d, e2), q = glm::cross(from - a, e1);
  const double det = glm::dot(e1, p);
  if (std::abs(det) < 1e-12) return false;
  const double u = glm::dot(from - a, p) / det, v = glm::dot(d, q) / det, t = glm::dot(e2, q) / det;
  return u > 0.001 && v > 0.001 && u + v < 0.999 && t > 0.0 && t < 1.0;
}

TEST_F(SvoLevelsTest, RaysMeetTheFinestLevelOfEachPlace) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  constexpr std::size_t kRays = 4000;
  const SvoSettings s = settings_of(32, 5, {0.31f, 0.26f, 0.6f});
  const std::vector<Corners> triangles = triangles_of_levels(s, 70);
  Random random;
  std::vector<glsl::SvoRay> rays(kRays);
  for (std::size_t i = 0; i < kRays; ++i) {
    // Within windows of all sizes, from one into another, along axes, outside of the grid.
    const auto place = [&](std::size_t kind) {
      const float reach = kind < 4 ? std::ldexp(0.5f, -static_cast<int>(kind)) : 1.2f;
      return glm::vec4(s.focus + reach * random.vector(-1.0f, 1.0f), 0.0f);
    };
    rays[i].from = place(i % 5);
    rays[i].to = place(i / 5 % 5);
    if (i % 16 == 1) rays[i].to.x = rays[i].from.x;
    if (i % 16 == 2) rays[i].to = glm::vec4(rays[i].from.x, rays[i].to.y, rays[i].from.z, 0.0f);
    if (i % 256 == 3) rays[i].to = rays[i].from;
  }
  for (const std::uint32_t way : {glsl::kSvoRestart, glsl::kVoxels}) {
    BuiltSvo built{};
    const std::vector<std::uint32_t> answers = trace(triangles, s, rays, way, &built);
    ASSERT_EQ(built.svo.memory.level_count, 5u);
    const std::set<TreeBox> leaves = expected_leaves(built);
    const SvoLevels& levels = built.svo.levels;
    const auto to_cells = [&](const glm::vec4& p) {
      return (glm::dvec3(p) - glm::dvec3(center_corner(levels))) / double{levels.levels.cell_size} +
             glm::dvec3(levels.levels.center);
    };
    const double growth = 4e-6 * (1u << (built.level() + 4));
    std::size_t blocked = 0, disagree = 0, behind_triangles = 0;
    for (std::size_t i = 0; i < kRays; ++i) {
      const glm::dvec3 from = to_cells(rays[i].from), to = to_cells(rays[i].to);
      const bool expected = from != to && is_blocked(leaves, from, to, 0.0);
      blocked += expected ? 1 : 0;
      if (expected != (answers[i] != 0)) {
        ++disagree;
        EXPECT_NE(is_blocked(leaves, from, to, growth), is_blocked(leaves, from, to, -growth)) << "ray " << i;
      }
      const bool behind = std::any_of(triangles.begin(), triangles.end(), [&](const Corners& corners) {
        return meets_triangle(corners, glm::dvec3(rays[i].from), glm::dvec3(rays[i].to));
      });
      const glm::vec4 middle(glm::vec3(0.5f), 0.0f);
      const bool inside = glm::all(glm::lessThan(glm::abs(rays[i].from - middle), glm::vec4(0.5f))) &&
                          glm::all(glm::lessThan(glm::abs(rays[i].to - middle), glm::vec4(0.5f)));
      if (!behind || !inside) continue;
      ++behind_triangles;
      EXPECT_NE(answers[i], 0u) << "ray " << i;
    }
    EXPECT_LE(disagree, kRays / 1000) << "way " << way;
    EXPECT_GT(blocked, kRays / 8);
    EXPECT_LT(blocked, kRays - kRays / 8);
    EXPECT_GT(behind_triangles, kRays / 50);
  }
}

// Frame by frame, about a focus that moves: the same as at once.
TEST_F(SvoLevelsTest, WindowsThatMoveOn) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  SvoSettings s = settings_of(64, 4, glm::vec3(0.3f));
  const std::vector<Corners> triangles = triangles_of_levels(s, 30);
  std::optional<SvoLevels> last;
  int built_frames = 0;
  for (int frame = 0; frame < 6; ++frame) {
    FrameGraph graph(executor().context());
    const GpuScene::Frame scene = upload_triangles(graph, triangles);
    const std::size_t before = graph.passes().size();
    const Svo svo = record_svo(graph, scene, kUnit, s, true, last ? &*last : nullptr);
    built_frames += graph.passes().size() > before ? 1 : 0;
    const BuiltSvo built = read(graph, svo);
    expect_tree_of_levels(built);
    last = svo.levels;
    s.focus += glm::vec3(frame % 2 == 0 ? 0.0005f : 0.04f);
  }
  EXPECT_EQ(built_frames, 3);
}

}  // namespace
}  // namespace lightwell
