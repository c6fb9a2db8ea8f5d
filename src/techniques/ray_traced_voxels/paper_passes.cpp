#include "techniques/ray_traced_voxels/paper_passes.h"

#include <glm/gtc/constants.hpp>

#include "graph/linear_dispatch.h"
#include "kernels/techniques/ray_traced_voxels/paper_final.comp.h"
#include "kernels/techniques/ray_traced_voxels/paper_materials.comp.h"
#include "kernels/techniques/ray_traced_voxels/paper_points.comp.h"
#include "kernels/techniques/ray_traced_voxels/paper_view.comp.h"
#include "kernels/techniques/ray_traced_voxels/paper_voxelize.frag.h"
#include "kernels/techniques/ray_traced_voxels/paper_voxelize.vert.h"
#include "kernels/techniques/ray_traced_voxels/paper_voxelize_exact.frag.h"

namespace lightwell {
namespace {

constexpr std::string_view kVoxelise = "ray-traced voxels: voxelise";
constexpr std::string_view kFinal = "ray-traced voxels: final";

ImageHandle create_result(FrameGraph& graph, std::string_view name, const GBuffer& gbuffer) {
  return graph.create_image(
      name, {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
}

glsl::VoxelFinalParams final_params(const PaperIrradiance& irradiance, glm::uvec2 size, const PaperLookUp& settings) {
  const float ambient = settings.ambient * glm::pi<float>() * irradiance.range;
  return {irradiance.grid, size, irradiance.range, ambient};
}

}  // namespace

PaperMaterials record_paper_materials(FrameGraph& graph, const GpuScene::Frame& scene, const VoxelGrid& grid,
                                      VoxelWriter writer, ExactSums& sums) {
  constexpr std::string_view kClear = "ray-traced voxels: voxelise: clear";
  constexpr std::string_view kResolve = "ray-traced voxels: voxelise: resolve";
  PaperMaterials materials{grid, graph.create_buffer("paper albedo", grid.cell_count, sizeof(std::uint32_t)),
                           graph.create_buffer("paper normals", grid.cell_count, sizeof(std::uint32_t))};
  graph.fill(kClear, materials.albedo, 0);
  graph.fill(kClear, materials.normals, 0);
  const bool exact = writer == VoxelWriter::kExact;
  if (exact) record_empty_list(graph, kClear, sums);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    RasterPass& pass = graph.raster(
        kVoxelise, kernels::ray_traced_voxels_paper_voxelize_vert,
        exact ? kernels::ray_traced_voxels_paper_voxelize_exact_frag : kernels::ray_traced_voxels_paper_voxelize_frag,
        {});
    pass.bind(scene.set).constant("kAxis", axis).index_buffer(scene.indices).push(glsl::VoxelDrawParams{grid});
    if (exact)
      write_exact_sums(pass, sums);
    else
      pass.constant("kWriter", static_cast<std::uint32_t>(writer))
          .write("albedo", materials.albedo)
          .write("normals", materials.normals);
    pass.render_area(grid.resolution[(axis + 1) % 3], grid.resolution[(axis + 2) % 3]).draw(3 * scene.triangle_count);
  }
  if (exact) {
    record_touched_groups(graph, kResolve, sums);
    ComputePass& pass = graph.compute(kResolve, kernels::ray_traced_voxels_paper_materials_comp)
                            .write("albedo", materials.albedo)
                            .write("normals", materials.normals);
    take_exact_sums(pass, sums);
  }
  return materials;
}

ImageHandle record_paper_final(FrameGraph& graph, const PaperIrradiance& irradiance, const GBuffer& gbuffer,
                               const PaperLookUp& settings) {
  ImageHandle result = create_result(graph, "voxel irradiance", gbuffer);
  graph.compute(kFinal, kernels::ray_traced_voxels_paper_final_comp)
      .constant("kTaps", settings.taps)
      .constant("kExact", irradiance.exact ? 1 : 0)
      .read("position", gbuffer.position)
      .read("irradiance", irradiance.voxels)
      .write("result", result)
      .push(final_params(irradiance, {gbuffer.width, gbuffer.height}, settings))
      .dispatch_threads(gbuffer.width, gbuffer.height);
  return result;
}

BufferHandle record_paper_points(FrameGraph& graph, const PaperIrradiance& irradiance, const Points& points,
                                 const PaperLookUp& settings) {
  BufferHandle result = graph.create_buffer("voxel irradiance at points", points.count, sizeof(glm::vec4));
  dispatch_linear(graph.compute(kFinal, kernels::ray_traced_voxels_paper_points_comp)
                      .constant("kTaps", settings.taps)
                      .constant("kExact", irradiance.exact ? 1 : 0)
                      .read("points", points.points)
                      .read("irradiance", irradiance.voxels)
                      .write("result", result)
                      .push(final_params(irradiance, {points.count, 1}, settings)),
                  points.count);
  return result;
}

ImageHandle record_paper_view(FrameGraph& graph, const PaperIrradiance& irradiance, const GBuffer& gbuffer) {
  ImageHandle result = create_result(graph, "voxels", gbuffer);
  graph.compute("ray-traced voxels: view", kernels::ray_traced_voxels_paper_view_comp)
      .constant("kExact", irradiance.exact ? 1 : 0)
      .read("position", gbuffer.position)
      .read("irradiance", irradiance.voxels)
      .write("result", result)
      .push(glsl::VoxelViewParams{irradiance.grid, {gbuffer.width, gbuffer.height}, irradiance.range})
      .dispatch_threads(gbuffer.width, gbuffer.height);
  return result;
}

ImageHandle record_paper_view(FrameGraph& graph, const VoxelGrid& grid, BufferHandle voxels, const GBuffer& gbuffer) {
  return record_paper_view(graph, {.grid = grid, .voxels = voxels}, gbuffer);
}

}  // namespace lightwell
