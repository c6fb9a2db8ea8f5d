#include "techniques/light_volume/paper_passes.h"

#include <utility>

#include "kernels/techniques/light_volume/paper_inject.comp.h"
#include "kernels/techniques/light_volume/paper_lookup.comp.h"
#include "kernels/techniques/light_volume/paper_propagate.comp.h"
#include "kernels/techniques/light_volume/paper_voxelize.frag.h"
#include "kernels/techniques/light_volume/paper_voxelize.vert.h"
#include "techniques/light_volume/paper_types.h"

namespace lightwell {

// The source renders into three intermediate volumes and combines them with MAX. A maximum does not care in which order
// it is taken, so all three passes write one volume here: a third of the memory, no combining pass, the same result.
BufferHandle record_paper_voxels(FrameGraph& graph, const GpuScene::Frame& scene, const LightTable::Frame& lights,
                                 const ShadowMaps::Frame& shadows, const VoxelGrid& grid) {
  BufferHandle voxels =
      graph.create_buffer("paper voxels", std::uint64_t{glsl::kPaperVoxelPlanes} * grid.cell_count, sizeof(float));
  graph.fill("clear voxels", voxels, 0);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t width = grid.resolution[(axis + 1) % 3];
    const std::uint32_t height = grid.resolution[(axis + 2) % 3];
    RasterPass& pass = graph.raster("voxelize", kernels::light_volume_paper_voxelize_vert,
                                    kernels::light_volume_paper_voxelize_frag, {});
    read_lights(pass, lights, shadows)
        .bind(scene.set)
        .constant("axis", axis)
        .index_buffer(scene.indices)
        .write("voxels", voxels)
        .push(glsl::PaperVoxelizeParams{grid, lights.count})
        .render_area(width, height)
        .draw(3 * scene.triangle_count);
  }
  return voxels;
}

PaperVolume record_paper_injection(FrameGraph& graph, const VoxelGrid& grid, BufferHandle voxels) {
  PaperVolume volume;
  volume.cells = graph.create_buffer("paper cells", grid.cell_count, sizeof(glm::vec4));
  volume.light = graph.create_buffer(
      "paper light", std::uint64_t{glsl::kPaperLightPlanes} * glsl::paper_plane_stride(grid.cell_count), sizeof(float));
  graph.compute("inject", kernels::light_volume_paper_inject_comp)
      .read("voxels", voxels)
      .write("cells", volume.cells)
      .write("light", volume.light)
      .push(glsl::PaperInjectParams{grid})
      .dispatch_threads(grid.resolution.x, grid.resolution.y, grid.resolution.z);
  return volume;
}

BufferHandle record_paper_propagation(FrameGraph& graph, const VoxelGrid& grid, PaperVolume& volume,
                                      const PaperTransport& transport) {
  const std::uint64_t floats = std::uint64_t{glsl::kPaperLightPlanes} * glsl::paper_plane_stride(grid.cell_count);
  BufferHandle received = graph.create_buffer("paper received", floats, sizeof(float));
  graph.fill("clear received", received, 0);
  BufferHandle next = graph.create_buffer("paper next light", floats, sizeof(float));
  for (std::uint32_t step = 0; step < transport.steps; ++step) {
    graph.compute("propagate", kernels::light_volume_paper_propagate_comp)
        .constant("occlusion", transport.occlusion ? 1 : 0)
        .read("cells", volume.cells)
        .read("source", volume.light)
        .write("target", next)
        .write("received", received)
        .push(glsl::PaperPropagateParams{grid, transport.reflectance})
        .dispatch_threads(grid.resolution.x, grid.resolution.y, grid.resolution.z);
    std::swap(volume.light, next);
  }
  return received;
}

ImageHandle record_paper_lookup(FrameGraph& graph, const VoxelGrid& grid, const PaperVolume& volume,
                                BufferHandle received, const GBuffer& gbuffer, bool occlusion) {
  ImageHandle irradiance =
      graph.create_image("indirect irradiance",
                         {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
  graph.compute("look up", kernels::light_volume_paper_lookup_comp)
      .constant("occlusion", occlusion ? 1 : 0)
      .read("cells", volume.cells)
      .read("received", received)
      .read("positions", gbuffer.position)
      .read("normals", gbuffer.normal)
      .write("irradiance", irradiance)
      .push(glsl::PaperLookupParams{grid, {gbuffer.width, gbuffer.height}})
      .dispatch_threads(gbuffer.width, gbuffer.height);
  return irradiance;
}

}  // namespace lightwell
