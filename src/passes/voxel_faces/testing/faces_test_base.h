// Base of tests that make the faces of voxels and look at them.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "graph/linear_dispatch.h"
#include "graph/testing/graph_test.h"
#include "kernels/passes/voxel_faces/testing/face_lookup.comp.h"
#include "passes/gpu_scene/gpu_scene_types.h"
#include "passes/voxel_faces/testing/face_lookup.h"
#include "passes/voxel_faces/voxel_faces.h"
#include "passes/voxel_grid/testing/level_oracle.h"
#include "passes/voxelize/testing/triangle_oracle.h"
#include "passes/voxelize/voxelize.h"

namespace lightwell {

inline constexpr Bounds kUnit{glm::vec3(0.0f), glm::vec3(1.0f)};

// Triangles of which a range moves; the revisions are the test's business.
struct TestTriangles {
  std::vector<Corners> triangles;
  std::uint32_t moving_first = 0;
  std::uint32_t moving_count = 0;
  SceneRevisions revisions{};
};

// What a frame left on the device; arrays by slot hold the slots in use alone.
struct FrameFaces {
  VoxelFaces faces;
  std::uint32_t found = 0;
  std::vector<std::uint32_t> table;
  std::vector<std::uint32_t> keys;
  std::vector<std::uint32_t> before;
  std::vector<std::uint32_t> areas;
  std::vector<std::uint32_t> cells;  // of all levels, of all triangles at once, as passes/voxelize makes them
  std::vector<std::uint32_t> slots;  // of the points asked about
  std::vector<std::string> passes;   // that the faces took
};

class VoxelFacesTest : public GraphTest {
 protected:
  static GpuScene::Frame upload(FrameGraph& graph, const TestTriangles& test) {
    std::vector<glsl::WorldVertex> vertices;
    for (const Corners& corners : test.triangles)
      for (const glm::vec3& corner : corners)
        vertices.push_back({glm::vec4(corner, 0.0f), glm::vec4(0.0f), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)});
    std::vector<std::uint32_t> indices(vertices.size());
    for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
    GpuScene::Frame scene;
    scene.vertices = graph.upload("vertices", std::span<const glsl::WorldVertex>(vertices));
    scene.indices = graph.upload("indices", std::span<const std::uint32_t>(indices));
    scene.triangle_count = static_cast<std::uint32_t>(test.triangles.size());
    scene.moving_first = test.moving_first;
    scene.moving_count = test.moving_count;
    scene.revisions = test.revisions;
    scene.set = create_scene_set(graph, scene);
    return scene;
  }

  // One frame of the scene that `declare(graph)` gives. `scope`: whose histories.
  template <class Declare>
  FrameFaces show_scene(const Bounds& bounds, const VoxelFaceSettings& settings, VoxelFaceMemory& memory,
                        std::string_view scope, const std::vector<glsl::SurfacePoint>& points, Declare&& declare) {
    FrameGraph graph(executor().context());
    const auto scoped = graph.enter(scope, false);
    const GpuScene::Frame scene = declare(graph);
    const std::size_t first_pass = graph.passes().size();
    FrameFaces shown;
    shown.faces = record_voxel_faces(graph, scene, bounds, focus_, settings, memory);
    for (std::size_t i = first_pass; i < graph.passes().size(); ++i)
      shown.passes.push_back(base_of(graph.passes()[i]).name);
    const VoxelFaces& faces = shown.faces;
    BufferHandle slots;
    if (!points.empty()) slots = look_up(graph, faces, points);
    const auto read = [&](BufferHandle buffer) { return buffer ? graph.read_back(buffer) : ReadbackTicket{}; };
    const ReadbackTicket table = read(faces.table), keys = read(faces.keys), before = read(faces.before),
                         areas = read(faces.areas), counts = read(faces.counts), found_slots = read(slots);
    std::vector<ReadbackTicket> cells;
    for (std::uint32_t level = 0; level < faces.levels.count; ++level)
      cells.push_back(read(record_voxelize(graph, scene, level_grid(faces.levels, level)).cells));
    run(graph);
    const auto words = fetch<std::uint32_t>(counts);
    shown.found = words[glsl::kFacesFound];
    const std::uint32_t stored = words[glsl::kFacesStored];
    const auto fetch_used = [&](const ReadbackTicket& ticket) {
      auto all = fetch<std::uint32_t>(ticket);
      all.resize(stored);
      return all;
    };
    EXPECT_LE(stored, faces.capacity);
    EXPECT_EQ(words[glsl::kFaceGroups] * words[glsl::kFaceGroups + 1] * words[glsl::kFaceGroups + 2],
              (stored + 63) / 64);
    shown.table = fetch<std::uint32_t>(table);
    shown.cells.resize(shown.table.size());
    for (std::uint32_t level = 0; level < faces.levels.count; ++level)
      place_cells(faces.levels, level, fetch<std::uint32_t>(cells[level]), shown.cells);
    shown.keys = fetch_used(keys);
    if (faces.before) shown.before = fetch_used(before);
    if (faces.areas) shown.areas = fetch_used(areas);
    if (slots) shown.slots = fetch<std::uint32_t>(found_slots);
    return shown;
  }

  FrameFaces show(const TestTriangles& test, const Bounds& bounds, const VoxelFaceSettings& settings,
                  VoxelFaceMemory& memory,
                  std::string_view scope = "test: ", const std::vector<glsl::SurfacePoint>& points = {}) {
    return show_scene(bounds, settings, memory, scope, points, [&](FrameGraph& graph) { return upload(graph, test); });
  }

  // From a level's grid to their places among the cells of all levels.
  static void place_cells(const VoxelLevels& levels, std::uint32_t level, const std::vector<std::uint32_t>& cells,
                          std::vector<std::uint32_t>& all) {
    const auto side = static_cast<int>(levels.resolution);
    const glm::ivec3 lower = level_lower(levels, level);
    std::size_t next = 0;
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
          all[index_of_cell(levels, {level, lower.x + x, lower.y + y, lower.z + z})] = cells[next++];
  }

  static BufferHandle look_up(FrameGraph& graph, const VoxelFaces& faces,
                              const std::vector<glsl::SurfacePoint>& points) {
    const auto count = static_cast<std::uint32_t>(points.size());
    BufferHandle slots = graph.create_buffer("slots", count, sizeof(std::uint32_t));
    dispatch_linear(graph.compute("look up", kernels::voxel_faces_testing_face_lookup_comp)
                        .read("points", graph.upload<glsl::SurfacePoint>("points", points))
                        .read("face_table", faces.table)
                        .write("slots", slots)
                        .push(glsl::FaceLookupParams{faces.levels, count}),
                    count);
    return slots;
  }

  glm::vec3 focus_{0.5f};

  // Table and keys are those of the frame's cells.
  static void expect_faces_of_cells(const FrameFaces& shown) {
    std::vector<std::uint32_t> table(shown.cells.size());
    std::vector<std::uint32_t> keys;
    std::uint32_t base = 0;
    for (std::size_t cell = 0; cell < shown.cells.size(); ++cell) {
      const std::uint32_t stored = (shown.cells[cell] | shown.cells[cell] >> glsl::kCellBackShift) & 63u;
      const auto count = static_cast<std::uint32_t>(std::popcount(stored));
      if (stored != 0 && base + count <= shown.faces.capacity) {
        table[cell] = base << 6 | stored;
        for (std::uint32_t d = 0; d < 6; ++d)
          if ((stored >> d & 1u) != 0) keys.push_back(static_cast<std::uint32_t>(8 * cell + d));
      }
      base += count;
    }
    EXPECT_EQ(shown.found, base);
    EXPECT_EQ(shown.keys, keys);
    EXPECT_EQ(shown.table, table);
  }
};

}  // namespace lightwell
