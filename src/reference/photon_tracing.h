// Photons on their way through the scene.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "reference/photon_map.h"
#include "reference/photon_sources.h"

namespace lightwell {

struct PhotonTracing {
  int count = 0;            // of photons to start
  std::uint64_t first = 0;  // number of the first one: other numbers are other photons
  int max_bounces = 0;      // at most this many before a photon is left where it arrives
  std::uint32_t seed = 1;
  int threads = 0;  // 0: all cores
};

// All arrivals but those of the first surface, which are direct light, in the order of the photons' numbers: the same
// ones whatever the number of threads. Their flux is divided by `count`, so that all together are indirect light once.
// A photon bounces with a probability that keeps the brightest channel of its flux as it is (Russian roulette).
// `on_block`, if set, is called after every block of photons, from any thread.
std::vector<Photon> trace_photons(const TracedWorld& world, const PhotonSources& sources, const PhotonTracing& tracing,
                                  const std::function<void()>& on_block = {});

// How often it calls on_block().
int photon_blocks(int count);

}  // namespace lightwell
