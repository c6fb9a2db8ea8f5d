// Photons start where views have seen photons of the frames before: all views of a world vote together.
#pragma once

#include <cstdint>

#include "passes/light_paths/light_paths.h"
#include "techniques/photon_splatting/photons.h"
#include "techniques/photon_splatting/splat_passes.h"

namespace lightwell {

class PhotonGuide {
 public:
  // Takes what views saw since the last call into account, and forgets all of it where lights have changed. False where
  // there is nothing to guide, or more sources than a guide holds: then paths start without one.
  bool begin(FrameGraph& graph, WorldFrame& world);

  // For this frame's paths; null without a guide.
  LightPathGuide* of_paths() { return is_active_ ? &guide_ : nullptr; }

  // Of a view: lets the splats that it sees vote for where their paths started. `strata`: of splats.
  void vote(FrameGraph& graph, const SplatScreen& screen, const Splats& splats, BufferHandle strata);

 private:
  bool is_active_ = false;
  SceneRevisions revisions_;  // of that frame
  LightPathGuide guide_;
};

}  // namespace lightwell
