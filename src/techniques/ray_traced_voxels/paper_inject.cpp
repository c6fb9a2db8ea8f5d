// The injection: rays, writers, sums over lights, and the range of 8 bits.
#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "graph/linear_dispatch.h"
#include "kernels/techniques/ray_traced_voxels/paper_add.comp.h"
#include "kernels/techniques/ray_traced_voxels/paper_inject_camera.comp.h"
#include "kernels/techniques/ray_traced_voxels/paper_inject_camera_voxels.comp.h"
#include "kernels/techniques/ray_traced_voxels/paper_inject_light.comp.h"
#include "kernels/techniques/ray_traced_voxels/paper_inject_light_voxels.comp.h"
#include "kernels/techniques/ray_traced_voxels/paper_resolve_exact.comp.h"
#include "kernels/techniques/ray_traced_voxels/paper_write.comp.h"
#include "kernels/techniques/ray_traced_voxels/paper_write_exact.comp.h"
#include "passes/rsm/rsm.h"
#include "techniques/ray_traced_voxels/paper_passes.h"

namespace lightwell {
namespace {

constexpr std::string_view kTrace = "ray-traced voxels: inject: trace";
constexpr std::string_view kClear = "ray-traced voxels: inject: clear";
constexpr std::string_view kWrite = "ray-traced voxels: inject: write";
constexpr std::string_view kResolve = "ray-traced voxels: inject: resolve";

// How far it is from `light` to surfaces, about.
float typical_distance(const WorldLight& light, const Bounds& bounds) {
  const glm::vec3 to_low = light.position - bounds.minimum;
  const glm::vec3 to_high = bounds.maximum - light.position;
  const bool inside = glm::all(glm::greaterThan(glm::min(to_low, to_high), glm::vec3(0.0f)));
  if (!inside) return glm::length(0.5f * (bounds.minimum + bounds.maximum) - light.position);
  if (light.type == LightType::kSpot) {
    float nearest = INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
      const float step = light.direction[axis];
      const float way = step < 0.0f ? to_low[axis] : to_high[axis];
      if (step != 0.0f) nearest = std::min(nearest, way / std::abs(step));
    }
    return nearest;
  }
  std::array<float, 6> distances{to_low.x, to_low.y, to_low.z, to_high.x, to_high.y, to_high.z};
  std::sort(distances.begin(), distances.end());
  return distances[2];
}

glsl::VoxelInjectParams inject_params(const WorldFrame& world, const PaperMaterials& materials,
                                      const PaperInjection& settings, std::uint32_t light) {
  constexpr float kRoom = 1e-3f;               // of the bounds' diagonal: rays start outside surfaces that lie in them
  constexpr float kLeastCells = 1.0f / 64.0f;  // in front of mirrored rays
  const Bounds bounds = finite_bounds(world);
  const float room = kRoom * glm::length(bounds.maximum - bounds.minimum);
  return {.grid = materials.grid,
          .low = bounds.minimum - room,
          .side = settings.side,
          .high = bounds.maximum + room,
          .light = light,
          .secondaries = std::min(settings.secondaries, glsl::kMostSecondaries),
          .least_distance = kLeastCells * materials.grid.cell_size};
}

ComputePass& rays_compute(FrameGraph& graph, WorldFrame& world, const PaperInjection& settings,
                          const TraceKernel& triangles, const KernelCode& voxels) {
  return settings.through_voxels ? graph.compute(kTrace, voxels) : trace_compute(graph, kTrace, triangles, world);
}

// One generation of a light's rays. `rays`: where the last ones hit, and then where these do.
void record_generation(FrameGraph& graph, WorldFrame& world, const PaperMaterials& materials,
                       const PaperInjection& settings, std::uint32_t light, std::uint32_t generation,
                       BufferHandle& hits, BufferHandle& rays) {
  dispatch_linear(rays_compute(graph, world, settings, kernels::ray_traced_voxels_paper_inject_light_comp,
                               kernels::ray_traced_voxels_paper_inject_light_voxels_comp)
                      .constant("kMirrored", generation > 0 ? 1 : 0)
                      .constant("kKeepRays", generation < settings.secondaries ? 1 : 0)
                      .read("lights", world.lights.lights)
                      .read("albedo", materials.albedo)
                      .read("normals", materials.normals)
                      .write("hits", hits)
                      .write("rays", rays)
                      .push(inject_params(world, materials, settings, light)),
                  paper_hit_count(settings.side));
}

BufferHandle create_hits(FrameGraph& graph, const PaperInjection& settings) {
  return graph.create_buffer("paper hits", paper_hit_count(settings.side), sizeof(glsl::VoxelHit));
}

BufferHandle create_rays(FrameGraph& graph, const PaperInjection& settings) {
  const std::uint32_t count = settings.secondaries > 0 ? paper_hit_count(settings.side) : 1;
  return graph.create_buffer("paper rays", count, sizeof(glsl::VoxelRay));
}

// A light's rays with all that follow them, written into `target`.
void record_light_rays(FrameGraph& graph, WorldFrame& world, const PaperMaterials& materials,
                       const PaperInjection& settings, std::uint32_t light, VoxelTarget& target, ExactSums& sums) {
  BufferHandle hits = create_hits(graph, settings);
  BufferHandle rays = create_rays(graph, settings);
  for (std::uint32_t generation = 0; generation <= settings.secondaries; ++generation) {
    record_generation(graph, world, materials, settings, light, generation, hits, rays);
    write_hits(graph, hits, paper_hit_count(settings.side), settings, target, sums);
  }
}

PaperIrradiance irradiance_of(const PaperMaterials& materials, const PaperInjection& settings, BufferHandle voxels) {
  return {materials.grid, voxels, settings.writer == VoxelWriter::kExact, settings.range};
}

}  // namespace

float choose_irradiance_range(std::span<const WorldLight> lights, const Bounds& bounds) {
  constexpr float kLeast = 1e-18f;
  float range = 0.0f;
  for (const WorldLight& light : lights) {
    const float intensity = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
    const float distance = light.type == LightType::kDirectional ? 1.0f : typical_distance(light, bounds);
    range = std::max(range, intensity / std::max(distance * distance, kLeast));
  }
  return range > kLeast ? std::min(range, kMaxLight) : 1.0f;
}

std::uint32_t paper_hit_count(std::uint32_t side) {
  const std::uint32_t blocks = (side + glsl::kRayBlock - 1) / glsl::kRayBlock;
  return blocks * blocks * glsl::kRayBlock * glsl::kRayBlock;
}

BufferHandle record_light_hits(FrameGraph& graph, WorldFrame& world, const PaperMaterials& materials,
                               const PaperInjection& settings, std::uint32_t light) {
  BufferHandle hits = create_hits(graph, settings);
  BufferHandle rays = create_rays(graph, settings);
  record_generation(graph, world, materials, settings, light, 0, hits, rays);
  return hits;
}

VoxelTarget begin_target(FrameGraph& graph, std::uint32_t cell_count, const PaperInjection& settings, ExactSums& sums) {
  VoxelTarget target;
  if (settings.writer == VoxelWriter::kExact) {
    record_empty_list(graph, kClear, sums);
    return target;
  }
  target.grid = graph.create_buffer("paper irradiance", cell_count, sizeof(std::uint32_t));
  graph.fill(kClear, target.grid, 0);
  return target;
}

void write_hits(FrameGraph& graph, BufferHandle hits, std::uint32_t hit_count, const PaperInjection& settings,
                VoxelTarget& target, ExactSums& sums) {
  const glsl::VoxelWriteParams params{hit_count, settings.range};
  if (settings.writer == VoxelWriter::kExact) {
    ComputePass& pass =
        graph.compute(kWrite, kernels::ray_traced_voxels_paper_write_exact_comp).read("hits", hits).push(params);
    dispatch_linear(write_exact_sums(pass, sums), hit_count / glsl::kExactRun);
    return;
  }
  dispatch_linear(graph.compute(kWrite, kernels::ray_traced_voxels_paper_write_comp)
                      .constant("kWriter", static_cast<std::uint32_t>(settings.writer))
                      .read("hits", hits)
                      .write("irradiance", target.grid)
                      .push(params),
                  hit_count);
}

void end_target(FrameGraph& graph, const VoxelTarget& target, std::uint32_t cell_count, const PaperInjection& settings,
                ExactSums& sums, BufferHandle& sum) {
  const glsl::VoxelAddParams params{cell_count, settings.range};
  if (settings.writer == VoxelWriter::kExact) {
    if (!sum) {
      sum = graph.create_buffer("paper irradiance", std::uint64_t{glsl::kExactIrradianceWords} * cell_count,
                                sizeof(std::uint32_t));
      graph.fill(kClear, sum, 0);
    }
    record_touched_groups(graph, kResolve, sums);
    ComputePass& pass = graph.compute(kResolve, kernels::ray_traced_voxels_paper_resolve_exact_comp)
                            .write("irradiance", sum)
                            .push(params);
    take_exact_sums(pass, sums);
  } else if (!sum) {
    sum = target.grid;
  } else {
    dispatch_linear(graph.compute("ray-traced voxels: inject: add", kernels::ray_traced_voxels_paper_add_comp)
                        .read("one", target.grid)
                        .write("irradiance", sum)
                        .push(params),
                    cell_count);
  }
}

PaperIrradiance record_light_injection(FrameGraph& graph, WorldFrame& world, const PaperMaterials& materials,
                                       const PaperInjection& settings, ExactSums& sums) {
  const std::uint32_t cell_count = materials.grid.cell_count;
  BufferHandle sum;
  const std::uint32_t light_count = std::min(world.lights.count, kMostPaperLights);
  for (std::uint32_t light = 0; light < std::max(light_count, 1u); ++light) {
    VoxelTarget target = begin_target(graph, cell_count, settings, sums);
    if (light < light_count) record_light_rays(graph, world, materials, settings, light, target, sums);
    end_target(graph, target, cell_count, settings, sums, sum);
  }
  return irradiance_of(materials, settings, sum);
}

PaperIrradiance record_camera_injection(FrameGraph& graph, WorldFrame& world, BufferHandle camera,
                                        const PaperMaterials& materials, const PaperInjection& settings,
                                        ExactSums& sums) {
  const std::uint32_t light_count = std::min(world.lights.count, kMostPaperLights);
  BufferHandle hits = create_hits(graph, settings);
  dispatch_linear(rays_compute(graph, world, settings, kernels::ray_traced_voxels_paper_inject_camera_comp,
                               kernels::ray_traced_voxels_paper_inject_camera_voxels_comp)
                      .read("lights", world.lights.lights)
                      .read("albedo", materials.albedo)
                      .read("normals", materials.normals)
                      .read("camera", camera)
                      .write("hits", hits)
                      .push(inject_params(world, materials, settings, light_count)),
                  paper_hit_count(settings.side));
  BufferHandle sum;
  VoxelTarget target = begin_target(graph, materials.grid.cell_count, settings, sums);
  write_hits(graph, hits, paper_hit_count(settings.side), settings, target, sums);
  end_target(graph, target, materials.grid.cell_count, settings, sums, sum);
  return irradiance_of(materials, settings, sum);
}

}  // namespace lightwell
