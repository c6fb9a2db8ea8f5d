// Direct light of emissive triangles and of the environment, by traced samples: soft shadows that converge over frames.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "graph/frame_graph.h"
#include "passes/lights/light_kinds.h"
#include "passes/view/view_frame.h"

namespace lightwell {

// Every frame takes `samples` points on emitters, as many directions of the environment's map and as many
// cosine-distributed rays at each visible surface. The mean over frames is the truth: nothing is clamped. What a few
// frames leave of noise is filtered, less and less as it falls.
class SampledLights {
 public:
  struct Settings {
    std::uint32_t samples = 1;  // of each kind, a pixel and frame; time in proportion
    bool filter = true;         // false: the mean as it is
    LightKinds kinds = LightKinds::kEmitters | LightKinds::kEnvironment;  // those of these two that are sampled
  };

  struct Frame {
    ImageHandle irradiance;  // RGBA32F, W/m^2 before albedo: what the frame adds to direct; empty: no such light
    ImageHandle mean;        // the same without the filter; w: frames in it
    ImageHandle sampled;     // of this frame alone
    bool steady = true;      // enough samples: another frame would hardly change it
  };

  SampledLights();
  ~SampledLights();

  // Declares this frame's passes; none where the world has no such light. Throws InputError if the device cannot hold
  // the list of emitters.
  Frame record(FrameGraph& graph, ViewFrame& view, const Settings& settings);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lightwell
