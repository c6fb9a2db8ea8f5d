// Faces in nested levels whose windows follow the focus: what was kept equals what is made anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "core/log.h"
#include "passes/voxel_faces/testing/faces_test_base.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 43;
constexpr VoxelFaceSettings kFiveLevels{.levels = {.resolution = 16, .finest_cell = 1.1f / 16.0f / 16.0f},
                                        .areas = true};

using Face = std::tuple<LevelCell, std::uint32_t>;  // cell and direction

std::map<Face, std::uint32_t> slots_of(const FrameFaces& shown) {
  std::map<Face, std::uint32_t> slots;
  for (std::uint32_t slot = 0; slot < shown.keys.size(); ++slot)
    slots[{cell_of_index(shown.faces.levels, shown.keys[slot] / 8), shown.keys[slot] % 8}] = slot;
  return slots;
}

class FaceLevelsTest : public VoxelFacesTest {
 protected:
  struct Walk {
    TestTriangles test;
    VoxelFaceMemory memory;
    FrameFaces last;
    std::size_t kept = 0, come = 0;
  };

  // One frame with the focus there. All is as if it had been made at once, and who was there last frame is found.
  void step(Walk& walk, const glm::vec3& focus) {
    focus_ = focus;
    FrameFaces shown = show(walk.test, kUnit, kFiveLevels, walk.memory);
    EXPECT_EQ(shown.faces.levels.count, 5u);
    ASSERT_EQ(shown.keys.size(), shown.found);
    expect_faces_of_cells(shown);
    if (shown.faces.moved) {
      expect_before(walk, shown);
    } else if (!shown.faces.fresh) {
      EXPECT_EQ(shown.keys, walk.last.keys);
    }
    walk.last = std::move(shown);
  }

  // A face has its slot of last frame if it was there, and it was if its cell was in the window.
  static void expect_before(Walk& walk, const FrameFaces& shown) {
    const std::map<Face, std::uint32_t> last = slots_of(walk.last);
    for (const auto& [face, slot] : slots_of(shown)) {
      const auto found = last.find(face);
      ASSERT_EQ(shown.before[slot], found == last.end() ? glsl::kNoFace : found->second);
      if (walk.test.moving_count == 0) {
        ASSERT_EQ(found != last.end(), shows(walk.last.faces.levels, std::get<0>(face)));
      }
      ++(found == last.end() ? walk.come : walk.kept);
    }
  }

  void expect_made_at_once(const Walk& walk) {
    TestTriangles at_once = walk.test;
    at_once.moving_first = at_once.moving_count = 0;
    VoxelFaceMemory nothing;
    const FrameFaces expected = show(at_once, kUnit, kFiveLevels, nothing, "at once: ");
    EXPECT_TRUE(expected.faces.fresh);
    EXPECT_EQ(walk.last.keys, expected.keys);
    EXPECT_EQ(walk.last.table, expected.table);
    EXPECT_EQ(walk.last.areas, expected.areas);
  }

  // Steps of a cell, of some, and across the scene; back and forth; now and then none.
  void walk_about(Walk& walk, int steps) {
    glm::vec3 focus(0.5f), before = focus;
    for (int i = 0; i < steps && !HasFatalFailure(); ++i) {
      const float reach = std::array{0.004f, 0.02f, 0.08f, 0.5f}[random_() % 4];
      const auto along = [&] { return std::uniform_real_distribution<float>(-reach, reach)(random_); };
      const glm::vec3 next = i % 5 == 4   ? before
                             : i % 7 == 6 ? focus
                                          : glm::clamp(focus + glm::vec3(along(), along(), along()), -0.1f, 1.1f);
      before = std::exchange(focus, next);
      if (walk.test.moving_count > 0 && i % 3 != 2) {
        for (std::uint32_t t = 0; t < walk.test.moving_count; ++t)
          for (glm::vec3& corner : walk.test.triangles[walk.test.moving_first + t])
            corner += glm::vec3(0.011f, -0.003f, 0.005f);
        ++walk.test.revisions.moving_geometry;
      }
      SCOPED_TRACE(i);
      step(walk, focus);
      if (i % 8 == 7) expect_made_at_once(walk);
    }
    EXPECT_GT(walk.kept, 2 * walk.come);
    EXPECT_GT(walk.come, 1000u);
  }

  std::mt19937 random_{kSeed};
};

// Without those so narrow that single precision cannot tell their normal: they change it with the window.
TestTriangles make_scene(int count = 1000) {
  TestTriangles test{.triangles = random_triangles(fit_voxel_grid(kUnit, 32), kSeed, count)};
  std::erase_if(test.triangles, [](const Corners& t) {
    const float longest = std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
    return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) < 1e-3f * longest;
  });
  test.revisions = {.static_geometry = 1, .moving_geometry = 1};
  return test;
}

TEST_F(FaceLevelsTest, AWalkKeepsWhatStaysInTheWindows) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Walk walk{.test = make_scene()};
  walk_about(walk, 40);
}

TEST_F(FaceLevelsTest, AWalkAmongThingsThatMove) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Walk walk{.test = make_scene()};
  walk.test.moving_first = 100;
  walk.test.moving_count = 60;
  walk_about(walk, 40);
}

// A step within kLevelSnap cells of every level records nothing; one of so many of the finest along an axis, a slab of
// that level and one of a coarser.
TEST_F(FaceLevelsTest, OnlyWhatIsNewIsVoxelised) {
  Walk walk{.test = make_scene()};
  const auto voxelised = [&] {
    return std::count(walk.last.passes.begin(), walk.last.passes.end(), "voxel faces: cells");
  };
  const float cell = fit_voxel_grid(kUnit, 16).cell_size / 16.0f;
  const glm::vec3 start(0.5f + 0.25f * cell);
  step(walk, start);
  EXPECT_EQ(voxelised(), 5);
  step(walk, start + 0.5f * cell);
  EXPECT_TRUE(walk.last.passes.empty());
  step(walk, start + glm::vec3(4.0f * cell, 0.0f, 0.0f));
  EXPECT_EQ(voxelised(), 2);
  step(walk, start + glm::vec3(4.0f * cell, 4.0f * cell, -4.0f * cell));
  EXPECT_GE(voxelised(), 2);
  EXPECT_LE(voxelised(), 6);
}

// Walls and floors in the planes between cells of every level.
TEST_F(FaceLevelsTest, SurfacesBetweenCells) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Walk walk;
  const VoxelGrid grid = fit_voxel_grid(kUnit, 16);
  for (int i = 0; i < 9; ++i) {
    const int axis = i % 3;
    const auto corner = [&](float u, float v) {
      glm::vec3 p = grid.origin;
      p[axis] += grid.cell_size / 4.0f * static_cast<float>(5 + i * 6);
      p[(axis + 1) % 3] += u * grid.cell_size * 16.0f;
      p[(axis + 2) % 3] += v * grid.cell_size * 16.0f;
      return p;
    };
    walk.test.triangles.push_back({corner(0.1f, 0.1f), corner(0.9f, 0.1f), corner(0.9f, 0.9f)});
    walk.test.triangles.push_back({corner(0.1f, 0.1f), corner(0.9f, 0.9f), corner(0.1f, 0.9f)});
  }
  walk.test.revisions = {.static_geometry = 1, .moving_geometry = 1};
  walk_about(walk, 16);
}

// Two walls and a point far away: what is near is looked up in fine cells, what is far in coarse ones.
TEST_F(FaceLevelsTest, PointsFindTheFinestLevelThatHasThem) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const TestTriangles floor{
      .triangles = {{glm::vec3(0.0f, 0.31f, 0.0f), glm::vec3(0.0f, 0.31f, 1.0f), glm::vec3(1.0f, 0.31f, 0.0f)},
                    {glm::vec3(1.0f, 0.31f, 1.0f), glm::vec3(1.0f, 0.31f, 0.0f), glm::vec3(0.0f, 0.31f, 1.0f)}}};
  focus_ = {0.4f, 0.312f, 0.6f};
  std::uniform_real_distribution<float> place(0.001f, 0.999f);
  std::vector<glsl::SurfacePoint> points;
  for (int i = 0; i < 4000; ++i)
    points.push_back({glm::vec4(place(random_), 0.31f, place(random_), 0.0f),
                      glm::vec4(0.0f, i % 2 == 0 ? 1.0f : -1.0f, 0.0f, 0.0f)});
  VoxelFaceMemory memory;
  const FrameFaces shown = show(floor, kUnit, kFiveLevels, memory, "test: ", points);
  const VoxelLevels& levels = shown.faces.levels;
  std::map<std::uint32_t, int> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_LT(shown.slots[i], shown.keys.size()) << i;
    const LevelCell cell = cell_of_index(levels, shown.keys[shown.slots[i]] / 8);
    ASSERT_EQ(shown.keys[shown.slots[i]] % 8, i % 2 == 0 ? 2u : 3u);
    ++found[cell.level];
    const float size = levels.cell_size * static_cast<float>(1u << cell.level);
    const glm::vec3 local = (glm::vec3(points[i].position) - levels.origin) / size - glm::vec3(cell.x, cell.y, cell.z);
    for (int axis = 0; axis < 3; ++axis) ASSERT_TRUE(local[axis] > -2e-3f && local[axis] < 1.002f) << i;
    // Nobody is in a level that ends nearer to the focus, or in a coarser one than need be.
    const glm::vec3 away = glm::abs(glm::vec3(points[i].position) - levels.focus);
    const float distance = std::max({away.x, away.y, away.z});
    const auto end = [&](std::uint32_t level) {
      return (0.5f * 16.0f - 3.0f) * levels.cell_size * static_cast<float>(1u << level);
    };
    if (cell.level + 1 < levels.count) {
      ASSERT_LT(distance, 1.001f * end(cell.level)) << i;
    }
    if (cell.level > 0) {
      ASSERT_GT(distance, 0.999f * end(cell.level - 1)) << i;
    }
  }
  EXPECT_GE(found.size(), 4u);
}

// More faces than there is room for at first: the next frame has room for all of them, and knows those of the first.
TEST_F(FaceLevelsTest, RoomGrowsWithNeed) {
  const WarningCapture log;
  Walk walk{.test = make_scene(8000)};
  const VoxelFaceSettings settings{.levels = {.resolution = 16}};
  const auto next = [&] {
    FrameFaces shown = show(walk.test, kUnit, settings, walk.memory);
    executor().notice_completed(frame_);
    return shown;
  };
  const FrameFaces first = next();
  EXPECT_LT(first.keys.size(), first.found);
  EXPECT_GT(first.keys.size() + 6, first.faces.capacity);
  const FrameFaces second = next();
  EXPECT_FALSE(second.faces.fresh);
  EXPECT_TRUE(second.faces.moved);
  EXPECT_EQ(second.keys.size(), first.found);
  ASSERT_GT(second.keys.size(), first.keys.size());
  std::size_t known = 0;
  for (std::size_t slot = 0; slot < second.keys.size(); ++slot) {
    if (second.before[slot] == glsl::kNoFace) continue;
    ASSERT_LT(second.before[slot], first.keys.size());
    ASSERT_EQ(first.keys[second.before[slot]], second.keys[slot]);
    ++known;
  }
  EXPECT_EQ(known, first.keys.size());
  const FrameFaces third = next();
  EXPECT_FALSE(third.faces.fresh || third.faces.moved);
  EXPECT_TRUE(third.passes.empty());
  EXPECT_TRUE(log.warnings().empty());
}

TEST_F(FaceLevelsTest, WhereTheBudgetEndsOneWarningIsGiven) {
  const WarningCapture log;
  Walk walk{.test = make_scene(8000)};
  constexpr std::uint32_t kMost = 13000;  // more than at first, less than need
  for (int frame = 0; frame < 5; ++frame) {
    const FrameFaces shown = show(walk.test, kUnit, {.levels = {.resolution = 16}, .capacity = kMost}, walk.memory);
    executor().notice_completed(frame_);
    EXPECT_GT(shown.found, kMost);
    EXPECT_EQ(shown.faces.fresh, frame == 0) << frame;
    if (frame > 0) {
      EXPECT_EQ(shown.faces.capacity, kMost);
    }
  }
  EXPECT_EQ(log.warnings().size(), 1u);
}

}  // namespace
}  // namespace lightwell
