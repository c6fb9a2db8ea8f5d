// Shadow rays: both traversals against exact marches on the CPU.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <glm/geometric.hpp>

#include "passes/svo/testing/svo_test_base.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 23;

// Positions in cells of the grid.
struct Segment {
  glm::dvec3 from, to;
};

// Whether the segment meets a leaf's closed box, grown by `growth` on every side. Visits the leaves of `side` cells
// that lie on the segment or beside it, one after the other along its longest axis.
bool is_blocked(const BuiltSvo& built, const std::vector<std::uint32_t>& leaves, std::uint32_t side, Segment s,
                double growth) {
  const glm::dvec3 d = s.to - s.from;
  const auto meets = [&](glm::ivec3 leaf) {
    const glm::dvec3 low = glm::dvec3(leaf) * double(side) - growth;
    const glm::dvec3 high = low + double(side) + 2.0 * growth;
    double enter = 0.0, leave = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (d[axis] == 0.0) {
        if (s.from[axis] < low[axis] || s.from[axis] > high[axis]) return false;
        continue;
      }
      const double a = (low[axis] - s.from[axis]) / d[axis], b = (high[axis] - s.from[axis]) / d[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
  };
  const int last = static_cast<int>((1u << built.level()) / side) - 1;
  const glm::dvec3 size = glm::abs(d);
  const int w = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const double low_w = std::min(s.from[w], s.to[w]) / side, high_w = std::max(s.from[w], s.to[w]) / side;
  for (int slab = static_cast<int>(std::floor(low_w - 0.1)); slab <= static_cast<int>(std::floor(high_w + 0.1));
       ++slab) {
    if (slab < 0 || slab > last) continue;
    // The segment's part in this slab of leaves.
    const double t0 = d[w] == 0.0 ? 0.0 : (slab * double(side) - s.from[w]) / d[w];
    const double t1 = d[w] == 0.0 ? 1.0 : ((slab + 1) * double(side) - s.from[w]) / d[w];
    const glm::dvec3 p = s.from + std::clamp(std::min(t0, t1), 0.0, 1.0) * d;
    const glm::dvec3 q = s.from + std::clamp(std::max(t0, t1), 0.0, 1.0) * d;
    const glm::ivec3 low(glm::floor(glm::min(p, q) / double(side) - 0.1));
    const glm::ivec3 high(glm::floor(glm::max(p, q) / double(side) + 0.1));
    glm::ivec3 leaf;
    for (leaf.z = low.z; leaf.z <= high.z; ++leaf.z) {
      for (leaf.y = low.y; leaf.y <= high.y; ++leaf.y) {
        for (leaf.x = low.x; leaf.x <= high.x; ++leaf.x) {
          if (leaf[w] != slab || glm::any(glm::lessThan(leaf, glm::ivec3(0))) ||
              glm::any(glm::greaterThan(leaf, glm::ivec3(last))))
            continue;
          if (std::binary_search(leaves.begin(), leaves.end(), pack_cell(leaf)) && meets(leaf)) return true;
        }
      }
    }
  }
  return false;
}

class SvoTraceTest : public SvoTest {
 protected:
  glm::dvec3 to_cells(const Svo& svo, glm::vec3 p) {
    return (glm::dvec3(p) - glm::dvec3(svo.grid.origin)) / double{svo.grid.cell_size};
  }

  // Answers against the exact ones, of rays between random places; `settings.epsilon` shortens restart's. Returns how
  // many levels the tree has less than its grid.
  std::uint32_t expect_exact(const SvoSettings& settings, std::uint32_t way, int triangle_count);
};

std::uint32_t SvoTraceTest::expect_exact(const SvoSettings& settings, std::uint32_t way, int triangle_count) {
  constexpr std::size_t kRays = 30000;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> uniform(-0.1f, 1.1f);
  std::vector<glsl::SvoRay> rays(kRays);
  for (std::size_t i = 0; i < kRays; ++i) {
    const auto place = [&] { return glm::vec4(uniform(random), uniform(random), uniform(random), 0.0f); };
    rays[i].from = place();
    rays[i].to = place();
    if (i % 16 == 1) rays[i].to.x = rays[i].from.x;  // along axes and planes, too
    if (i % 16 == 2) rays[i].to = glm::vec4(rays[i].from.x, rays[i].to.y, rays[i].from.z, 0.0f);
    if (i % 16 == 3) rays[i].to = rays[i].from + 0.02f * (rays[i].to - rays[i].from);
    if (i % 256 == 4) rays[i].to = rays[i].from;
  }
  const VoxelGrid grid = fit_voxel_grid(kUnit, settings.resolution);
  BuiltSvo built{};
  const std::vector<std::uint32_t> answers =
      trace(random_triangles(grid, kSeed, triangle_count), settings, rays, way, &built);
  const std::uint32_t level = built.level();
  const std::uint32_t leaf_log2 = way == glsl::kSvoRestart ? level - built.reached() : 0;
  std::vector<std::uint32_t> leaves;
  for (const std::uint32_t cell : built.occupied_cells()) {
    leaves.push_back(pack_cell(unpack_cell(cell) >> leaf_log2));
  }
  std::sort(leaves.begin(), leaves.end());

  const double step_epsilon = 1e-6 * (1u << level);
  std::size_t blocked = 0, disagree = 0;
  for (std::size_t i = 0; i < kRays; ++i) {
    Segment s{to_cells(built.svo, glm::vec3(rays[i].from)), to_cells(built.svo, glm::vec3(rays[i].to))};
    bool expected = false;
    if (way == glsl::kSvoRestart) {
      const double whole = glm::length(s.to - s.from);
      const double epsilon = double{settings.epsilon} * (1u << leaf_log2);
      const glm::dvec3 cut = epsilon * (s.to - s.from) / std::max(whole, 1e-9);
      s = {s.from + cut, s.to - cut};
      if (whole > 2.0 * epsilon) expected = is_blocked(built, leaves, 1u << leaf_log2, s, 0.0);
    } else if (s.from != s.to) {
      expected = is_blocked(built, leaves, 1, s, 0.0);
    }
    blocked += expected ? 1 : 0;
    if (expected == (answers[i] != 0)) continue;
    ++disagree;
    // Near an edge: the answer is another one with boxes a little larger or smaller.
    EXPECT_NE(is_blocked(built, leaves, 1u << leaf_log2, s, 2.0 * step_epsilon),
              is_blocked(built, leaves, 1u << leaf_log2, s, -2.0 * step_epsilon))
        << "ray " << i;
  }
  EXPECT_LE(static_cast<double>(disagree), 1e-4 * kRays) << disagree;
  EXPECT_GT(blocked, kRays / 12);
  EXPECT_LT(blocked, kRays - kRays / 12);
  return level - built.reached();
}

TEST_F(SvoTraceTest, BothTraversalsEqualExactMarches) {
  for (const std::uint32_t resolution : {8u, 16u, 64u, 256u}) {
    for (const std::uint32_t way : {glsl::kSvoRestart, glsl::kVoxels}) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", " + std::to_string(resolution) + ", way " +
                   std::to_string(way));
      expect_exact({.resolution = resolution, .epsilon = 0.0f}, way, resolution < 64 ? 10 : 100);
    }
  }
}

// Where rays look for larger boxes, too.
TEST_F(SvoTraceTest, TheFinestGrid) {
  for (const std::uint32_t way : {glsl::kSvoRestart, glsl::kVoxels}) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", way " + std::to_string(way));
    EXPECT_EQ(expect_exact({.resolution = 1024, .budget = std::uint64_t{300} << 20, .epsilon = 0.0f}, way, 30), 0u);
  }
}

TEST_F(SvoTraceTest, RestartShortensRaysByEpsilon) {
  expect_exact({.resolution = 64, .epsilon = 1.8f}, glsl::kSvoRestart, 100);
}

TEST_F(SvoTraceTest, RestartWalksTreesThatEndEarly) {
  EXPECT_GT(expect_exact({.resolution = 128, .budget = 700 << 10, .epsilon = 0.0f}, glsl::kSvoRestart, 60), 0u);
}

}  // namespace
}  // namespace lightwell
