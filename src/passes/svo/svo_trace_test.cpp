// Shadow rays: both traversals against exact marches on the CPU, and what rays between surfaces lose and leak.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "passes/svo/testing/svo_test_base.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 23;
constexpr Bounds kUnit{glm::vec3(0.0f), glm::vec3(1.0f)};

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
          const std::uint32_t packed = static_cast<std::uint32_t>(leaf.x | (leaf.y << 10) | (leaf.z << 20));
          if (std::binary_search(leaves.begin(), leaves.end(), packed) && meets(leaf)) return true;
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

  // Builds and asks at once.
  std::vector<std::uint32_t> trace(const std::vector<Corners>& triangles, const SvoSettings& settings,
                                   const std::vector<glsl::SvoRay>& rays, std::uint32_t way,
                                   BuiltSvo* built = nullptr) {
    FrameGraph graph(executor().context());
    const Svo svo = record_svo(graph, upload_triangles(graph, triangles), kUnit, settings);
    const BufferHandle blocked =
        add_rays(graph, svo, graph.upload<glsl::SvoRay>("rays", rays), static_cast<std::uint32_t>(rays.size()), way);
    const ReadbackTicket ticket = graph.read_back(blocked);
    if (built != nullptr)
      *built = read(graph, svo);
    else
      run(graph);
    return fetch<std::uint32_t>(ticket);
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
    const glm::uvec3 c = (glm::uvec3(cell, cell >> 10, cell >> 20) & 1023u) >> leaf_log2;
    leaves.push_back(c.x | (c.y << 10) | (c.z << 20));
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

// ---- rays between surfaces ----

// From cells of a scene that is turned about the grid's middle.
glm::vec3 to_world(const VoxelGrid& grid, const glm::dmat3& turn, glm::dvec3 cells) {
  const glm::dvec3 middle(0.5 * grid.resolution.x);
  return glm::vec3(glm::dvec3(grid.origin) + (middle + turn * (cells - middle)) * double{grid.cell_size});
}

// A box of two triangles a side.
void add_box(std::vector<Corners>& triangles, const VoxelGrid& grid, glm::dvec3 low, glm::dvec3 high,
             const glm::dmat3& turn = glm::dmat3(1.0)) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool top : {false, true}) {
      const auto corner = [&](bool u, bool v) {
        glm::dvec3 p = low;
        p[axis] = top ? high[axis] : low[axis];
        if (u) p[(axis + 1) % 3] = high[(axis + 1) % 3];
        if (v) p[(axis + 2) % 3] = high[(axis + 2) % 3];
        return to_world(grid, turn, p);
      };
      triangles.push_back({corner(false, false), corner(true, false), corner(true, true)});
      triangles.push_back({corner(false, false), corner(true, true), corner(false, true)});
    }
  }
}

struct BoxPoint {
  glm::dvec3 position, normal;  // inwards
};

BoxPoint random_on_box(std::mt19937& random, glm::dvec3 low, glm::dvec3 high) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const glm::dvec3 size = high - low;
  const glm::dvec3 areas(size.y * size.z, size.z * size.x, size.x * size.y);
  const double pick = uniform(random) * (areas.x + areas.y + areas.z);
  const int axis = pick < areas.x ? 0 : pick < areas.x + areas.y ? 1 : 2;
  BoxPoint p{low + size * glm::dvec3(uniform(random), uniform(random), uniform(random)), glm::dvec3(0.0)};
  const bool top = uniform(random) < 0.5;
  p.position[axis] = top ? high[axis] : low[axis];
  p.normal[axis] = top ? -1.0 : 1.0;
  return p;
}

glm::dvec3 cosine_direction(std::mt19937& random, glm::dvec3 normal) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double z = 1.0 - 2.0 * uniform(random), phi = 2.0 * std::numbers::pi * uniform(random);
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return normal + glm::dvec3(r * std::cos(phi), r * std::sin(phi), z);
}

// Where a ray that starts inside meets the box.
BoxPoint exit_of_box(glm::dvec3 from, glm::dvec3 direction, glm::dvec3 low, glm::dvec3 high) {
  double t = 1e300;
  BoxPoint p{from, glm::dvec3(0.0)};
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const bool up = direction[axis] > 0.0;
    const double exit = ((up ? high[axis] : low[axis]) - from[axis]) / direction[axis];
    if (exit >= t || exit <= 1e-9) continue;
    t = exit;
    p.normal = glm::dvec3(0.0);
    p.normal[axis] = up ? -1.0 : 1.0;
  }
  p.position = from + t * direction;
  return p;
}

glsl::SvoRay surface_ray(const VoxelGrid& grid, const glm::dmat3& turn, const BoxPoint& from, const BoxPoint& to) {
  return {glm::vec4(to_world(grid, turn, from.position), 0.0f), glm::vec4(turn * from.normal, 0.0f),
          glm::vec4(to_world(grid, turn, to.position), 0.0f), glm::vec4(turn * to.normal, 0.0f)};
}

// Where walls lie in their cells: on borders, just beside them, inside.
constexpr double kOffsets[] = {0.0, 1e-6, 0.02, 0.25, 0.5, 0.75, 0.98, 1.0 - 1e-6};

class SurfaceRaysTest : public SvoTraceTest {
 protected:
  // Of the light that is exchanged between the walls of an empty box over more than 2 cells: cosine-distributed rays
  // from points spread evenly carry equal parts.
  double visible_in_box(std::uint32_t resolution, double low_offset, double high_offset, const SvoSettings& settings,
                        std::uint32_t way, const glm::dmat3& turn = glm::dmat3(1.0)) {
    constexpr std::size_t kRays = 20000;
    const VoxelGrid grid = fit_voxel_grid(kUnit, resolution);
    // Turned ones are smaller, so that they fit.
    const double margin = turn == glm::dmat3(1.0) ? 2.0 : 0.25 * resolution;
    const glm::dvec3 low(margin + low_offset), high(resolution - margin - 1.0 + high_offset);
    std::vector<Corners> triangles;
    add_box(triangles, grid, low, high, turn);
    std::mt19937 random(kSeed);
    std::vector<glsl::SvoRay> rays;
    while (rays.size() < kRays) {
      const BoxPoint from = random_on_box(random, low, high);
      const BoxPoint to = exit_of_box(from.position, cosine_direction(random, from.normal), low, high);
      if (glm::length(to.position - from.position) > 2.0) rays.push_back(surface_ray(grid, turn, from, to));
    }
    const std::vector<std::uint32_t> blocked = trace(triangles, settings, rays, way);
    return 1.0 - static_cast<double>(std::count(blocked.begin(), blocked.end(), 1u)) / kRays;
  }

  // Two rooms and a wall between them, `thickness` in cells: the part of the light that reaches surfaces of one from
  // those of the other, of what would without the wall.
  double leak(std::uint32_t resolution, double offset, double thickness, const SvoSettings& settings,
              std::uint32_t way) {
    constexpr std::size_t kRays = 20000;
    const VoxelGrid grid = fit_voxel_grid(kUnit, resolution);
    const glm::dvec3 low(2.0 + offset), high(resolution - 3.0 + offset);
    glm::dvec3 wall_low = low, wall_high = high;
    wall_low.x = 0.5 * resolution + offset;
    wall_high.x = wall_low.x + thickness;
    std::vector<Corners> triangles;
    add_box(triangles, grid, low, high);
    add_box(triangles, grid, wall_low, wall_high);
    std::mt19937 random(kSeed);
    std::vector<glsl::SvoRay> rays;
    while (rays.size() < kRays) {
      const BoxPoint from = random_on_box(random, low, high);
      const BoxPoint to = exit_of_box(from.position, cosine_direction(random, from.normal), low, high);
      const double a = std::min(from.position.x, to.position.x), b = std::max(from.position.x, to.position.x);
      if (a < wall_low.x && b > wall_high.x) rays.push_back(surface_ray(grid, glm::dmat3(1.0), from, to));
    }
    const std::vector<std::uint32_t> blocked = trace(triangles, settings, rays, way);
    return 1.0 - static_cast<double>(std::count(blocked.begin(), blocked.end(), 1u)) / kRays;
  }
};

TEST_F(SurfaceRaysTest, AnEmptyBoxIsEmpty) {
  for (const std::uint32_t resolution : {64u, 128u})
    for (const double low : kOffsets)
      for (const double high : {low, 1.0 - low, 0.5})
        EXPECT_GE(
            visible_in_box(resolution, low, high, {.resolution = resolution, .tree = false}, glsl::kVoxelsBetween),
            0.99)
            << resolution << ": " << low << " " << high << ", seed " << kSeed;
}

TEST_F(SurfaceRaysTest, AWallOfTwoCellsIsTight) {
  for (const std::uint32_t resolution : {64u, 128u})
    for (const double offset : kOffsets)
      EXPECT_LE(leak(resolution, offset, 2.0, {.resolution = resolution, .tree = false}, glsl::kVoxelsBetween), 0.01)
          << resolution << ": " << offset << ", seed " << kSeed;
}

// About all three axes.
const glm::dmat3 kTurned(glm::rotate(glm::dmat4(1.0), 0.6, glm::normalize(glm::dvec3(1.0, 2.0, -0.7))));

// Its walls fill cells in steps, out of which some rays do not come. The box has half as many cells a side.
TEST_F(SurfaceRaysTest, ATurnedBoxIsNearlyEmpty) {
  for (const std::uint32_t resolution : {64u, 128u})
    EXPECT_GE(
        visible_in_box(resolution, 0.3, 0.1, {.resolution = resolution, .tree = false}, glsl::kVoxelsBetween, kTurned),
        0.98)
        << resolution << ", seed " << kSeed;
}

class DISABLED_SvoTable : public SurfaceRaysTest {};

// Not part of the run:
//   lightwell_passes_test --gtest_also_run_disabled_tests --gtest_filter='*SvoTable.*'
// The published traversal over its epsilon, beside ours: walls in the middle of cells, the worst of kOffsets, a turned
// box; a wall of two cells, and one without thickness.
TEST_F(DISABLED_SvoTable, LossAndLeak) {
  const auto print = [&](const char* name, SvoSettings settings, std::uint32_t way) {
    for (const std::uint32_t resolution : {64u, 128u}) {
      settings.resolution = resolution;
      double least = 1.0, most = 0.0;
      for (const double offset : kOffsets) {
        least = std::min(least, visible_in_box(resolution, offset, 1.0 - offset, settings, way));
        most = std::max(most, leak(resolution, offset, 2.0, settings, way));
      }
      std::printf(
          "%-24s %4u^3: visible %.4f mid-cell, %.4f worst, %.4f turned; leak %.4f mid-cell, %.4f worst, %.4f plane\n",
          name, resolution, visible_in_box(resolution, 0.5, 0.5, settings, way), least,
          visible_in_box(resolution, 0.3, 0.1, settings, way, kTurned), leak(resolution, 0.5, 2.0, settings, way), most,
          leak(resolution, 0.5, 0.0, settings, way));
    }
  };
  for (const float epsilon : {0.5f, 1.0f, 1.8f, 3.0f, 5.0f, 8.0f})
    print(("restart, epsilon " + std::to_string(epsilon).substr(0, 3)).c_str(), {.epsilon = epsilon},
          glsl::kSvoRestart);
  print("voxels between surfaces", {}, glsl::kVoxelsBetween);
}

}  // namespace
}  // namespace lightwell
