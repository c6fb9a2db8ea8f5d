// Runs the preset `best` on a scene. For tests only.
#pragma once

#include <memory>
#include <utility>

#include "techniques/light_volume/surfel_passes.h"
#include "techniques/light_volume/surfel_solver.h"
#include "techniques/technique_frames.h"

namespace lightwell {

struct SurfelFrames : TechniqueFrames {
  SurfelFrames(Device& device, Scene scene, const LightVolumeBestOptions& options, std::uint32_t side = 64)
      : TechniqueFrames(device, std::move(scene), std::make_unique<LightVolumeBest>(options), side) {}
};

}  // namespace lightwell
