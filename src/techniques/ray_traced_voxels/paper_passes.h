// The stages of the published ray-traced voxels as graph passes: Magalhaes 2020. Buffers and parameters: paper_types.h.
#pragma once

#include <cstdint>
#include <span>

#include "passes/gbuffer/gbuffer.h"
#include "passes/voxel_grid/voxel_grid.h"
#include "passes/world/world.h"
#include "techniques/points.h"
#include "techniques/ray_traced_voxels/paper_exact.h"
#include "techniques/ray_traced_voxels/paper_types.h"

namespace lightwell {

enum class VoxelWriter : std::uint8_t {
  kAverage = glsl::kWriteAverage,
  kMaximum = glsl::kWriteMaximum,
  kNone = glsl::kWriteNone,
  kExact = glsl::kWriteExact
};

// What surfaces are made of, RGBA8 a voxel.
struct PaperMaterials {
  VoxelGrid grid;
  BufferHandle albedo;
  BufferHandle normals;  // n * 0.5 + 0.5
};

struct PaperInjection {
  std::uint32_t side = 512;       // side^2 rays a light, or from the camera
  std::uint32_t secondaries = 0;  // mirrored rays that follow each, at most kMostSecondaries
  bool through_voxels = false;    // rays meet voxels instead of triangles
  VoxelWriter writer = VoxelWriter::kAverage;
  float range = 1.0f;  // W/m^2 that 255 stands for, > 0
};

struct PaperIrradiance {
  VoxelGrid grid;
  BufferHandle voxels;  // RGBA8 a voxel in parts of `range`; with the exact writer three floats, W/m^2
  bool exact = false;
  float range = 1.0f;
};

struct PaperLookUp {
  std::uint32_t taps = 7;  // 1 or 7
  float ambient = 0.2f;    // irradiance from everywhere, in parts of pi * range
};

// Only the first so many lights shine: each has a grid of its own for a while.
inline constexpr std::uint32_t kMostPaperLights = 64;

// W/m^2 for PaperInjection::range where nobody chose one: what the brightest light gives a surface at a distance that
// is typical for the place where it stands inside `bounds`. Directional: its irradiance. Spot: as far as its axis runs
// inside `bounds`. Point: the third smallest of its distances from their six sides. From outside `bounds`: as far as
// their centre. 1 where no light shines.
float choose_irradiance_range(std::span<const WorldLight> lights, const Bounds& bounds);

// Three drawings of the scene, one along each axis. `sums`, here and below: where the writer is the exact one, else
// unused.
PaperMaterials record_paper_materials(FrameGraph& graph, const GpuScene::Frame& scene, const VoxelGrid& grid,
                                      VoxelWriter writer, ExactSums& sums);

// Rays from every light, each light's grid added to those before.
PaperIrradiance record_light_injection(FrameGraph& graph, WorldFrame& world, const PaperMaterials& materials,
                                       const PaperInjection& settings, ExactSums& sums);

// Rays from a camera (glsl::GpuCamera): a grid of what it sees, under all lights.
PaperIrradiance record_camera_injection(FrameGraph& graph, WorldFrame& world, BufferHandle camera,
                                        const PaperMaterials& materials, const PaperInjection& settings,
                                        ExactSums& sums);

// RGBA32F: irradiance (W/m^2) at each pixel with a surface, 0 elsewhere.
ImageHandle record_paper_final(FrameGraph& graph, const PaperIrradiance& irradiance, const GBuffer& gbuffer,
                               const PaperLookUp& settings);
// The same, a vec4 a point.
BufferHandle record_paper_points(FrameGraph& graph, const PaperIrradiance& irradiance, const Points& points,
                                 const PaperLookUp& settings);

// RGBA32F: what is stored for each pixel's place.
ImageHandle record_paper_view(FrameGraph& graph, const PaperIrradiance& irradiance, const GBuffer& gbuffer);
ImageHandle record_paper_view(FrameGraph& graph, const VoxelGrid& grid, BufferHandle voxels, const GBuffer& gbuffer);

// ---- the injection's parts ----

// Elements of the buffers of rays.
std::uint32_t paper_hit_count(std::uint32_t side);

// Where one light's rays hit first: glsl::VoxelHit, paper_hit_count() of them.
BufferHandle record_light_hits(FrameGraph& graph, WorldFrame& world, const PaperMaterials& materials,
                               const PaperInjection& settings, std::uint32_t light);

// Writes hits into a grid of one light's or camera's own: begin, write any number of times, end. The end adds it to
// `sum`; an empty handle begins a sum.
struct VoxelTarget {
  BufferHandle grid;  // RGBA8 a voxel; none with the exact writer
};
VoxelTarget begin_target(FrameGraph& graph, std::uint32_t cell_count, const PaperInjection& settings, ExactSums& sums);
void write_hits(FrameGraph& graph, BufferHandle hits, std::uint32_t hit_count, const PaperInjection& settings,
                VoxelTarget& target, ExactSums& sums);
void end_target(FrameGraph& graph, const VoxelTarget& target, std::uint32_t cell_count, const PaperInjection& settings,
                ExactSums& sums, BufferHandle& sum);

}  // namespace lightwell
