// Faces against the cells that they are of, frame by frame.
#include "passes/voxel_faces/voxel_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "core/log.h"
#include "passes/voxel_faces/testing/faces_test_base.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 23;
constexpr VoxelFaceSettings kWithAreas{.levels = {.resolution = 32}, .areas = true};

void move(TestTriangles& test, glm::vec3 by) {
  for (std::uint32_t i = 0; i < test.moving_count; ++i)
    for (glm::vec3& corner : test.triangles[test.moving_first + i]) corner += by;
  ++test.revisions.moving_geometry;
}

std::ptrdiff_t count_passes(const FrameFaces& shown, std::string_view name) {
  return std::count(shown.passes.begin(), shown.passes.end(), name);
}

class VoxelFacesMotionTest : public VoxelFacesTest {
 protected:
  // One frame, which must equal everything made at once.
  FrameFaces step(const TestTriangles& test, const VoxelFaceSettings& settings = kWithAreas) {
    FrameFaces shown = show(test, kUnit, settings, memory_);
    expect_faces_of_cells(shown);
    TestTriangles at_once = test;
    at_once.moving_first = at_once.moving_count = 0;
    VoxelFaceMemory nothing;
    EXPECT_EQ(shown.areas, show(at_once, kUnit, settings, nothing, "at once: ").areas);
    EXPECT_EQ(shown.faces.moved, static_cast<bool>(shown.faces.before));
    if (shown.faces.moved) expect_before(shown);
    last_keys_ = shown.keys;
    return shown;
  }

  void expect_before(const FrameFaces& shown) {
    std::map<std::uint32_t, std::uint32_t> last_slots;
    for (std::uint32_t slot = 0; slot < last_keys_.size(); ++slot) last_slots[last_keys_[slot]] = slot;
    std::vector<std::uint32_t> before;
    for (const std::uint32_t key : shown.keys) {
      const auto last = last_slots.find(key);
      before.push_back(last == last_slots.end() ? glsl::kNoFace : last->second);
    }
    EXPECT_EQ(shown.before, before);
  }

  VoxelFaceMemory memory_;

 private:
  std::vector<std::uint32_t> last_keys_;
};

TestTriangles make_scene() {
  TestTriangles test{.triangles = random_triangles(fit_voxel_grid(kUnit, 32), kSeed, 300)};
  test.revisions = {.static_geometry = 1, .moving_geometry = 1};
  return test;
}

TEST_F(VoxelFacesTest, SlotsAreInOrderOfCells) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  for (const std::uint32_t resolution : {1u, 7u, 32u, 96u}) {
    const VoxelGrid grid = fit_voxel_grid(kUnit, resolution);
    for (const int count : {1, 40, 400}) {
      VoxelFaceMemory memory;
      const FrameFaces shown = show({.triangles = random_triangles(grid, kSeed, count)}, kUnit,
                                    {.levels = {.resolution = resolution}}, memory, std::to_string(count));
      EXPECT_TRUE(shown.faces.fresh);
      EXPECT_FALSE(shown.faces.moved);
      EXPECT_FALSE(shown.faces.areas);
      expect_faces_of_cells(shown);
      if (count == 400) {
        EXPECT_GT(shown.found, 2 * resolution * resolution);
      }
    }
  }
}

// Many surfaces a cell, so that additions meet in all orders.
TEST_F(VoxelFacesTest, TheSameTrianglesInAnyOrderGiveTheSameBytes) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  TestTriangles test{.triangles = random_triangles(fit_voxel_grid(kUnit, 8), kSeed, 3000)};
  VoxelFaceMemory first_memory, second_memory, third_memory;
  const VoxelFaceSettings settings{.levels = {.resolution = 8}, .areas = true};
  const FrameFaces first = show(test, kUnit, settings, first_memory, "first: ");
  const FrameFaces second = show(test, kUnit, settings, second_memory, "second: ");
  std::reverse(test.triangles.begin(), test.triangles.end());
  const FrameFaces third = show(test, kUnit, settings, third_memory, "third: ");
  for (const FrameFaces* other : {&second, &third}) {
    EXPECT_EQ(other->table, first.table);
    EXPECT_EQ(other->keys, first.keys);
    EXPECT_EQ(other->areas, first.areas);
  }
}

TEST_F(VoxelFacesMotionTest, ThingsThatMoveAndComeToRest) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  TestTriangles test = make_scene();
  EXPECT_TRUE(step(test).faces.fresh);
  EXPECT_TRUE(step(test).passes.empty());

  // Some begin to move: what stands is made once, and then kept.
  test.moving_first = 120;
  test.moving_count = 50;
  ++test.revisions.static_geometry;
  move(test, glm::vec3(0.013f, 0.0f, -0.007f));
  EXPECT_EQ(count_passes(step(test), "voxelize: cells"), 6);
  for (int frame = 0; frame < 3; ++frame) {
    move(test, glm::vec3(0.02f, -0.011f, 0.017f));
    const FrameFaces shown = step(test);
    EXPECT_FALSE(shown.faces.fresh);
    EXPECT_TRUE(shown.faces.moved);
    EXPECT_EQ(count_passes(shown, "voxelize: cells"), 3);
  }
  EXPECT_TRUE(step(test).passes.empty());

  // At rest they stand elsewhere in the order; no face changes.
  std::rotate(test.triangles.begin() + 120, test.triangles.begin() + 170, test.triangles.end());
  test.moving_first = test.moving_count = 0;
  ++test.revisions.static_geometry;
  const FrameFaces rested = step(test);
  EXPECT_TRUE(std::is_sorted(rested.before.begin(), rested.before.end()));
  EXPECT_TRUE(step(test).passes.empty());

  // Others, the first ones and in the end all.
  test.moving_count = 30;
  ++test.revisions.static_geometry;
  move(test, glm::vec3(0.0f, 0.031f, 0.0f));
  step(test);
  test.moving_count = 300;
  ++test.revisions.static_geometry;
  move(test, glm::vec3(0.0f, -0.02f, 0.01f));
  step(test);
}

TEST_F(VoxelFacesMotionTest, AGridThatThingsLeaveIsMadeAnew) {
  TestTriangles test{.triangles = {{glm::vec3(0.1f), glm::vec3(0.2f), glm::vec3(0.1f, 0.2f, 0.4f)}}};
  const auto show_in = [&](float side) {
    ++test.revisions.moving_geometry;
    return show(test, {glm::vec3(0.0f), glm::vec3(side)}, {.levels = {.resolution = 16}}, memory_);
  };
  const VoxelGrid first = level_grid(show_in(1.0f).faces.levels, 0);
  const FrameFaces inside = show_in(0.9f);
  EXPECT_TRUE(is_same_grid(level_grid(inside.faces.levels, 0), first));
  EXPECT_FALSE(inside.faces.fresh);
  const FrameFaces beyond = show_in(1.1f);
  EXPECT_FALSE(is_same_grid(level_grid(beyond.faces.levels, 0), first));
  EXPECT_TRUE(beyond.faces.fresh);
  EXPECT_GT(upper_corner(level_grid(beyond.faces.levels, 0)).x, 1.15f);
  expect_faces_of_cells(beyond);
  const FrameFaces small = show_in(0.5f);
  EXPECT_TRUE(small.faces.fresh);
  EXPECT_LT(small.faces.levels.cell_size, first.cell_size);
}

TEST_F(VoxelFacesMotionTest, AFrameThatIsDroppedMakesAllFresh) {
  TestTriangles test = make_scene();
  step(test);
  {
    FrameGraph dropped(executor().context());
    const auto scope = dropped.enter("test: ", false);
    TestTriangles moved = test;
    ++moved.revisions.moving_geometry;
    record_voxel_faces(dropped, upload(dropped, moved), kUnit, focus_, kWithAreas, memory_);
  }
  EXPECT_TRUE(step(test).faces.fresh);
}

TEST_F(VoxelFacesMotionTest, FacesBeyondTheRoomAreLeftOutAndCounted) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const WarningCapture log;
  TestTriangles test = make_scene();
  test.moving_first = 200;
  test.moving_count = 50;
  for (const std::uint32_t capacity : {1000u, 3001u, 1u}) {
    for (int frame = 0; frame < 2; ++frame) {
      move(test, glm::vec3(0.01f));
      const FrameFaces shown = step(test, {.levels = {.resolution = 32}, .areas = true, .capacity = capacity});
      EXPECT_GT(shown.found, capacity);
      EXPECT_LE(shown.keys.size(), capacity);
      EXPECT_GT(shown.keys.size() + 6, capacity);
    }
  }
  executor().notice_completed(frame_);
  const std::vector<std::string> warnings = log.warnings();
  // One for each memory: the test's own, and those of "at once".
  std::size_t own = 0;
  for (const std::string& warning : warnings) {
    EXPECT_NE(warning.find("there is room for"), std::string::npos) << warning;
    own += warning.find("room for 1000") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(warnings.size(), 7u);
  EXPECT_EQ(own, 3u);
}

TEST_F(VoxelFacesMotionTest, EverythingFitsExactly) {
  TestTriangles test = make_scene();
  VoxelFaceMemory probe;
  const std::uint32_t found = show(test, kUnit, kWithAreas, probe, "probe: ").found;
  const FrameFaces exact = step(test, {.levels = {.resolution = 32}, .areas = true, .capacity = found});
  EXPECT_EQ(exact.keys.size(), found);
}

TEST_F(VoxelFacesTest, TrianglesThatAreNoPlacesHaveNoFaces) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  TestTriangles test = make_scene();
  const TestTriangles sound = test;
  for (std::size_t i = 0; i < 100; ++i) {
    Corners corners = sound.triangles[i];
    corners[i % 3][static_cast<int>(i / 3 % 3)] = i % 2 == 0 ? kNan : kInfinity;
    test.triangles.push_back(corners);
  }
  test.moving_first = 250;
  test.moving_count = 100;
  VoxelFaceMemory memory, sound_memory;
  const FrameFaces shown = show(test, kUnit, kWithAreas, memory);
  const FrameFaces expected = show(sound, kUnit, kWithAreas, sound_memory, "sound: ");
  expect_faces_of_cells(shown);
  EXPECT_EQ(shown.table, expected.table);
  EXPECT_EQ(shown.areas, expected.areas);

  // Bounds that hold such a triangle are infinite: there is no grid to be in.
  for (int frame = 0; frame < 2; ++frame) {
    const std::vector<glsl::SurfacePoint> points{
        {glm::vec4(0.5f), glm::vec4(0.0f, 1.0f, 0.0f, 0.0f)}, {glm::vec4(kNan), glm::vec4(kNan)}, {}};
    const Bounds everywhere{glm::vec3(-kInfinity), glm::vec3(kInfinity)};
    const FrameFaces nowhere = show(test, everywhere, kWithAreas, memory, "test: ", points);
    EXPECT_EQ(nowhere.found, 0u);
    EXPECT_EQ(nowhere.slots, std::vector<std::uint32_t>(3, glsl::kNoFace));
  }
}

TEST_F(VoxelFacesTest, TrianglesWithoutAnAreaHaveNoFaces) {
  VoxelFaceMemory memory;
  const glm::vec3 a(0.2f), b(0.7f, 0.3f, 0.6f);
  const FrameFaces shown = show({.triangles = {{a, b, b}, {a, a, a}}}, kUnit, kWithAreas, memory);
  EXPECT_EQ(shown.found, 0u);
  EXPECT_NE(std::count(shown.cells.begin(), shown.cells.end(), glsl::kCellOccupied), 0);
}

TEST_F(VoxelFacesTest, AWorldThatIsCutIsMadeAnew) {
  const Scene scene = load_scene(LIGHTWELL_SOURCE_DIR "/scenes/room.gltf");
  const SceneSnapshot snapshot = take_snapshot(scene);
  World world(device(), scene, snapshot, {});
  VoxelFaceMemory memory;
  for (int frame = 0; frame < 4; ++frame) {
    const bool cut = frame == 2;
    FrameGraph graph(executor().context());
    WorldFrame world_frame(graph, world, snapshot, 0.1 * frame, cut);
    const std::size_t passes = graph.passes().size();
    const VoxelFaces faces = record_voxel_faces(graph, world_frame, kWithAreas, memory);
    EXPECT_EQ(faces.fresh, frame == 0 || cut) << frame;
    EXPECT_EQ(graph.passes().size() > passes, frame == 0 || cut) << frame;
    EXPECT_FALSE(faces.moved);
    run(graph);
  }
}

TEST_F(VoxelFacesTest, ASceneWithoutTrianglesHasNoFaces) {
  VoxelFaceMemory memory;
  TestTriangles test{.triangles = {{glm::vec3(0.1f), glm::vec3(0.2f), glm::vec3(0.1f, 0.2f, 0.4f)}}};
  FrameGraph graph(executor().context());
  GpuScene::Frame scene = upload(graph, test);
  scene.triangle_count = 0;
  const VoxelFaces faces = record_voxel_faces(graph, scene, kUnit, focus_, kWithAreas, memory);
  const ReadbackTicket counts = graph.read_back(faces.counts);
  run(graph);
  EXPECT_EQ(fetch<std::uint32_t>(counts)[glsl::kFacesFound], 0u);
}

}  // namespace
}  // namespace lightwell
