// Runs stages of the published light volume on hand-made volumes.
#pragma once

#include <algorithm>
#include <cstring>
#include <vector>

#include <glm/geometric.hpp>

#include "gpu/submit.h"
#include "graph/executor.h"
#include "graph/testing/graph_test.h"
#include "techniques/light_volume/paper_passes.h"
#include "techniques/light_volume/paper_types.h"

namespace lightwell {

struct TestVolume {
  VoxelGrid grid;
  std::vector<glm::vec4> cells;  // normal, 1 where occupied
  std::vector<float> light;      // kPaperLightPlanes planes

  explicit TestVolume(std::uint32_t resolution)
      : grid(fit_voxel_grid({glm::vec3(0.0f), glm::vec3(1.0f)}, resolution)),
        cells(grid.cell_count, glm::vec4(0.0f)),
        light(std::size_t{glsl::kPaperLightPlanes} * glsl::paper_plane_stride(grid.cell_count), 0.0f) {}

  std::size_t index(glm::ivec3 c) const {
    return (static_cast<std::size_t>(c.z) * grid.resolution.y + static_cast<std::size_t>(c.y)) * grid.resolution.x +
           static_cast<std::size_t>(c.x);
  }

  template <class Visit>  // visit(cell, index)
  void for_each_cell(const Visit& visit) const {
    const glm::ivec3 end(grid.resolution);
    for (int z = 0; z < end.z; ++z)
      for (int y = 0; y < end.y; ++y)
        for (int x = 0; x < end.x; ++x) visit(glm::ivec3(x, y, z), index({x, y, z}));
  }

  glm::vec4 coefficients(const std::vector<float>& planes, std::size_t cell, std::uint32_t channel = 0) const {
    const std::size_t plane = glsl::paper_plane_stride(grid.cell_count);
    const std::size_t at = 4 * channel * plane + cell;
    return {planes[at], planes[at + plane], planes[at + 2 * plane], planes[at + 3 * plane]};
  }

  // The same in all channels.
  void set_light(std::size_t cell, glm::vec4 sh) {
    for (std::uint32_t plane = 0; plane < glsl::kPaperLightPlanes; ++plane) {
      light[std::size_t{plane} * glsl::paper_plane_stride(grid.cell_count) + cell] = sh[static_cast<int>(plane % 4)];
    }
  }

  // The outermost cells become walls that look inwards.
  void close() {
    const int last = static_cast<int>(grid.resolution.x) - 1;
    for_each_cell([&](glm::ivec3 c, std::size_t i) {
      const glm::vec3 normal(glm::ivec3(glm::equal(c, glm::ivec3(0))) - glm::ivec3(glm::equal(c, glm::ivec3(last))));
      if (normal != glm::vec3(0.0f)) cells[i] = glm::vec4(glm::normalize(normal), 1.0f);
    });
  }
};

class PaperVolumeTest : public GraphTest {
 protected:
  static PaperVolume upload(FrameGraph& graph, const TestVolume& volume) {
    const BufferHandle staged = graph.upload("test light", std::span<const float>(volume.light));
    PaperVolume handles;
    handles.cells = graph.upload("test cells", std::span<const glm::vec4>(volume.cells));
    handles.light = graph.create_buffer("light", volume.light.size(), sizeof(float));
    graph.copy("stage light", staged, handles.light, volume.light.size() * sizeof(float));
    return handles;
  }

  // Moves volume.light and returns what cells received.
  std::vector<float> propagate(TestVolume& volume, const PaperTransport& transport) {
    FrameGraph graph(executor().context());
    PaperVolume handles = upload(graph, volume);
    const BufferHandle received = record_paper_propagation(graph, volume.grid, handles, transport);
    const ReadbackTicket light_ticket = graph.read_back(handles.light);
    const ReadbackTicket received_ticket = graph.read_back(received);
    run(graph);
    volume.light = fetch<float>(light_ticket);
    return fetch<float>(received_ticket);
  }
};

}  // namespace lightwell
