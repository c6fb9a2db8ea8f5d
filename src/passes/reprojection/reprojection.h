// Where each pixel's surface was last frame: what every history of this view is fetched by.
#pragma once

#include "graph/frame_graph.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/reprojection/history_pairs.h"
#include "shaders/camera.h"

namespace lightwell {

// Of one view. A texel of last frame is a valid tap of a pixel if it showed the same surface: the distance that the
// motion of the pixel's surface says, a normal within acos(0.9) = 26 degrees, the same material.
class Reprojection {
 public:
  struct Frame {
    ImageHandle motion;  // of the G-buffer
    ImageHandle taps;    // R32UI: bits of valid taps (history_taps.glsl)
  };

  // Declares the pass; call it once a frame. `reset`: the frames before say nothing about this one.
  Frame record(FrameGraph& graph, const GBuffer& gbuffer, const glsl::GpuCamera& camera, bool reset);

 private:
  HistoryPairs histories_;
};

// Binds what passes/reprojection/reprojection.glsl reads.
Pass& read_reprojection(Pass& pass, const Reprojection::Frame& reprojection);

}  // namespace lightwell
