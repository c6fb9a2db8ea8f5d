// Ray-traced voxels: light that rays bring into voxels, and out of them.
#include "lightwell/error.h"
#include "techniques/ray_traced_voxels/best.h"
#include "techniques/ray_traced_voxels/paper.h"

namespace lightwell {
namespace {

constexpr std::string_view kPresets[] = {"best", "paper"};

std::unique_ptr<Technique> create_ray_traced_voxels(std::string_view preset) {
  if (preset == "best") return std::make_unique<RayTracedVoxelsBest>();
  LW_ASSERT(preset == "paper", std::string(preset));
  return std::make_unique<RayTracedVoxelsPaper>();
}

}  // namespace

extern const TechniqueInfo kTechnique_ray_traced_voxels;
const TechniqueInfo kTechnique_ray_traced_voxels{
    "ray-traced-voxels",
    "Light that rays bring into voxels, and out of them (Magalhaes 2020).",
    kPresets,
    create_ray_traced_voxels,
};

}  // namespace lightwell
