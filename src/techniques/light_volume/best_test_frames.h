// Runs the preset `best` on a scene. For tests only.
#pragma once

#include <memory>
#include <utility>

#include "techniques/light_volume/best.h"
#include "techniques/technique_frames.h"

namespace lightwell {

// The preset's, but for these.
inline LightCacheOptions best_options(int resolution, int links, int links_per_frame) {
  LightCacheOptions options = LightVolumeBest::kDefaults;
  options.resolution = resolution;
  options.links = links;
  options.links_per_frame = links_per_frame;
  return options;
}

struct BestFrames : TechniqueFrames {
  BestFrames(Device& device, Scene scene, const LightCacheOptions& options, std::uint32_t side = 64)
      : TechniqueFrames(device, std::move(scene), std::make_unique<LightVolumeBest>(options), side) {
    samples_sources = true;
  }
};

}  // namespace lightwell
