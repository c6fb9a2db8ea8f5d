#include "techniques/ray_traced_voxels/paper.h"

#include <array>
#include <string>
#include <string_view>

#include "core/log.h"
#include "passes/rsm/rsm.h"

namespace lightwell {

void RayTracedVoxelsPaper::describe(OptionVisitor& visitor) {
  constexpr OptionScope kWorld = OptionScope::kWorld;
  visitor.visit(
      {"resolution", "Voxels along each axis of the grid.", "voxels", "time and memory with its cube", kWorld},
      options_.resolution, 16, 256);
  visitor.visit({"rays", "Side of the square of rays that a light, or the camera, sends out.", "rays",
                 "time and memory with its square", kWorld},
                options_.rays, 8, 2048);
  constexpr std::array<std::string_view, 4> kWriters{"average", "maximum", "none", "exact"};
  int writer = static_cast<int>(options_.writer);
  visitor.visit({"writer",
                 "What becomes of many rays or fragments in one voxel: their moving average (published), the largest "
                 "packed word, whoever comes last, or exact sums and a count.",
                 "", "", kWorld},
                writer, kWriters);
  options_.writer = static_cast<VoxelWriter>(writer);
  constexpr std::array<std::string_view, 2> kInjections{"light", "camera"};
  int inject = static_cast<int>(options_.inject);
  visitor.visit({"inject", "Where rays come from that light voxels.", "", "", kWorld}, inject, kInjections);
  options_.inject = static_cast<VoxelInjection>(inject);
  visitor.visit({"secondaries", "Mirrored rays that follow each ray.", "rays", "a ray each", kWorld},
                options_.secondaries, 0, static_cast<int>(glsl::kMostSecondaries));
  visitor.visit(
      {"irradiance-range", "Irradiance that the largest of 8 bits stands for; 0: chosen from the brightest light.",
       "W/m^2", "coarser steps; less: bright places are cut off", kWorld},
      options_.irradiance_range, 0.0f, kMaxLight);
  constexpr std::array<std::string_view, 2> kTraced{"triangles", "voxels"};
  int traced = options_.trace_voxels ? 1 : 0;
  visitor.visit({"trace", "What rays meet.", "", "", kWorld}, traced, kTraced);
  options_.trace_voxels = traced == 1;
  constexpr std::array<std::string_view, 2> kTaps{"1", "7"};
  int taps = options_.taps == 7 ? 1 : 0;
  visitor.visit({"taps", "Places in the grid of which a pixel takes the mean.", "", "blur, and time in proportion"},
                taps, kTaps);
  options_.taps = taps == 1 ? 7 : 1;
  visitor.visit({"ambient", "Light added everywhere: irradiance in parts of pi times the range.", "", ""},
                options_.ambient, 0.0f, 10.0f);
}

void RayTracedVoxelsPaperWorld::record_world(FrameGraph& graph, WorldFrame& world) {
  const Bounds bounds = finite_bounds(world);
  injection_ = {.side = static_cast<std::uint32_t>(options_.rays),
                .secondaries = static_cast<std::uint32_t>(options_.secondaries),
                .through_voxels = options_.trace_voxels,
                .writer = options_.writer,
                .range = options_.irradiance_range > 0.0f ? options_.irradiance_range
                                                          : choose_irradiance_range(world.lights.world, bounds)};
  if (world.lights.count > kMostPaperLights && !warned_) {
    warned_ = true;
    log_warning("ray-traced-voxels: of " + std::to_string(world.lights.count) + " lights only the first " +
                std::to_string(kMostPaperLights) + " shine");
  }
  const VoxelGrid grid = fit_voxel_grid(world.grid_bounds, static_cast<std::uint32_t>(options_.resolution));
  sums_ = options_.writer == VoxelWriter::kExact ? record_exact_sums(graph, grid.cell_count) : ExactSums{};
  materials_ = record_paper_materials(graph, world.scene, grid, options_.writer, sums_);
  irradiance_ = {};
  if (options_.inject == VoxelInjection::kLight)
    irradiance_ = record_light_injection(graph, world, materials_, injection_, sums_);
}

BufferHandle RayTracedVoxelsPaperWorld::record_points(FrameGraph& graph, WorldFrame&, const Points& points) {
  if (!irradiance_.voxels) return {};
  return record_paper_points(graph, irradiance_, points, {.ambient = 0.0f});
}

PaperIrradiance RayTracedVoxelsPaperWorld::record_irradiance(FrameGraph& graph, ViewFrame& view) {
  if (options_.inject == VoxelInjection::kLight) return irradiance_;
  return record_camera_injection(graph, view.world, view.camera_buffer, materials_, injection_, sums_);
}

GiResult RayTracedVoxelsPaper::record_view(FrameGraph& graph, TechniqueWorld* world_part, ViewFrame& view) {
  auto& world = *static_cast<RayTracedVoxelsPaperWorld*>(world_part);
  const PaperIrradiance irradiance = world.record_irradiance(graph, view);
  const PaperMaterials& materials = world.materials();
  views_ = {{"irradiance-voxels", record_paper_view(graph, irradiance, view.gbuffer)},
            {"albedo-voxels", record_paper_view(graph, materials.grid, materials.albedo, view.gbuffer)},
            {"normal-voxels", record_paper_view(graph, materials.grid, materials.normals, view.gbuffer)}};
  return {.irradiance = record_paper_final(graph, irradiance, view.gbuffer,
                                           {static_cast<std::uint32_t>(options_.taps), options_.ambient})};
}

}  // namespace lightwell
