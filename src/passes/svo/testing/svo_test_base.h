// Base of tests that build an octree and look at it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "graph/linear_dispatch.h"
#include "graph/testing/graph_test.h"
#include "kernels/passes/svo/testing/svo_rays.comp.h"
#include "kernels/passes/svo/testing/voxel_rays.comp.h"
#include "passes/gpu_scene/gpu_scene_types.h"
#include "passes/svo/svo.h"
#include "passes/svo/testing/svo_rays.h"
#include "passes/voxelize/testing/triangle_oracle.h"

namespace lightwell {

inline std::uint32_t pack_cell(glm::uvec3 c) {
  return c.x | (c.y << 10) | (c.z << 20);
}
inline glm::uvec3 unpack_cell(std::uint32_t c) {
  return glm::uvec3(c, c >> 10, c >> 20) & 1023u;
}

inline constexpr Bounds kUnit{glm::vec3(0.0f), glm::vec3(1.0f)};

// What a build left on the device.
struct BuiltSvo {
  Svo svo;
  std::vector<glm::uvec4> nodes;
  std::vector<std::uint32_t> bits;
  std::vector<std::uint32_t> coarse;
  std::vector<std::uint32_t> counts;
  std::vector<glsl::SvoRecord> records;

  std::uint32_t level() const { return svo.memory.level; }
  std::uint32_t reached() const { return counts[glsl::kSvoLevelReached]; }
  bool is_occupied(glm::uvec3 cell) const {
    const glm::uvec3 brick = cell >> 2u;
    const std::uint32_t log2 = level() - 2;
    const std::size_t words = 2 * (brick.x | (std::size_t{brick.y} << log2) | (std::size_t{brick.z} << (2 * log2)));
    const std::uint32_t bit = (cell.x & 3u) | ((cell.y & 3u) << 2) | ((cell.z & 3u) << 4);
    return ((bits[words + bit / 32] >> (bit % 32)) & 1u) != 0;
  }
  // Packed, of those occupied.
  std::vector<std::uint32_t> occupied_cells() const {
    std::vector<std::uint32_t> cells;
    const std::uint32_t log2 = level() - 2;
    const std::uint32_t mask = (1u << log2) - 1u;
    for (std::size_t word = 0; word < bits.size(); ++word) {
      if (bits[word] == 0) continue;
      const auto brick = static_cast<std::uint32_t>(word / 2);
      const glm::uvec3 first = 4u * glm::uvec3(brick & mask, (brick >> log2) & mask, brick >> (2 * log2));
      for (std::uint32_t b = 0; b < 32; ++b) {
        if (((bits[word] >> b) & 1u) == 0) continue;
        const std::uint32_t bit = b + 32 * (word % 2);
        const glm::uvec3 cell = first + glm::uvec3(bit & 3u, (bit >> 2) & 3u, bit >> 4);
        cells.push_back(pack_cell(cell));
      }
    }
    std::sort(cells.begin(), cells.end());
    return cells;
  }
};

class SvoTest : public GraphTest {
 protected:
  static GpuScene::Frame upload_triangles(FrameGraph& graph, const std::vector<Corners>& triangles) {
    std::vector<glsl::WorldVertex> vertices;
    for (const Corners& corners : triangles)
      for (const glm::vec3& corner : corners)
        vertices.push_back({glm::vec4(corner, 0.0f), glm::vec4(0.0f), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)});
    std::vector<std::uint32_t> indices(vertices.size());
    for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
    GpuScene::Frame scene;
    scene.vertices = graph.upload("vertices", std::span<const glsl::WorldVertex>(vertices));
    scene.indices = graph.upload("indices", std::span<const std::uint32_t>(indices));
    scene.triangle_count = static_cast<std::uint32_t>(triangles.size());
    scene.set = create_scene_set(graph, scene);
    return scene;
  }

  // `declare(graph)` gives the scene's frame.
  template <class Declare>
  BuiltSvo build(const Bounds& bounds, const SvoSettings& settings, Declare&& declare) {
    FrameGraph graph(executor().context());
    const GpuScene::Frame scene = declare(graph);
    return read(graph, record_svo(graph, scene, bounds, settings));
  }
  BuiltSvo build(const std::vector<Corners>& triangles, const Bounds& bounds, const SvoSettings& settings) {
    return build(bounds, settings, [&](FrameGraph& graph) { return upload_triangles(graph, triangles); });
  }

  // Runs the graph.
  BuiltSvo read(FrameGraph& graph, const Svo& svo) {
    const ReadbackTicket nodes = svo.nodes ? graph.read_back(svo.nodes) : ReadbackTicket{};
    const ReadbackTicket records = svo.records ? graph.read_back(svo.records) : ReadbackTicket{};
    const ReadbackTicket bits = graph.read_back(svo.bits);
    const ReadbackTicket coarse = graph.read_back(svo.coarse);
    const ReadbackTicket counts = graph.read_back(svo.counts);
    run(graph);
    BuiltSvo built{.svo = svo, .nodes = {}, .bits = {}, .coarse = {}, .counts = {}, .records = {}};
    if (svo.nodes) built.nodes = fetch<glm::uvec4>(nodes);
    if (svo.records) built.records = fetch<glsl::SvoRecord>(records);
    built.bits = fetch<std::uint32_t>(bits);
    built.coarse = fetch<std::uint32_t>(coarse);
    built.counts = fetch<std::uint32_t>(counts);
    return built;
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

  static BufferHandle add_rays(FrameGraph& graph, const Svo& svo, BufferHandle rays, std::uint32_t count,
                               std::uint32_t way) {
    BufferHandle blocked = graph.create_buffer("blocked", count, sizeof(std::uint32_t));
    ComputePass& pass = graph.compute("svo: rays", way == glsl::kSvoRestart ? kernels::svo_testing_svo_rays_comp
                                                                            : kernels::svo_testing_voxel_rays_comp);
    if (way != glsl::kSvoRestart) pass.constant("kBetween", way == glsl::kVoxelsBetween ? 1 : 0);
    pass.bind(svo.set).read("rays", rays).write("blocked", blocked).push(glsl::SvoRayParams{count});
    dispatch_linear(pass, count);
    return blocked;
  }
};

}  // namespace lightwell
