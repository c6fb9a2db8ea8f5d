// Stratification: light points of one cell of a grid become one bundle, sparsely: memory goes with the light points,
// not with the grid.
#pragma once

#include <cstdint>

#include "techniques/photon_splatting/photons.h"

namespace lightwell {

// Which photon a bundle takes its place and direction from.
enum class Representative : std::uint8_t { kRandom, kNearestToMean };

struct StratifySettings {
  std::uint32_t cells = 64;     // along the longest axis of the world's grid bounds: 16 to 256, a power of two
  std::uint32_t threshold = 2;  // photons
  std::uint32_t levels = 1;     // 0 to glsl::kMostMergeLevels
  Representative representative = Representative::kRandom;
};

// A splat for each bundle. A block of 2^l x 2^l x 2^l cells, 1 <= l <= levels, becomes one bundle where one of its
// eight parts holds photons, but fewer than the threshold; a bundle is the largest such block, or a cell. Its splat has
// the flux of all its photons, and place, direction and bounces of one of them. `paths`: of all rounds.
void record_bundles(FrameGraph& graph, WorldFrame& world, const SizedLightPaths& paths,
                    const StratifySettings& settings, PhotonSplats& splats);

}  // namespace lightwell
