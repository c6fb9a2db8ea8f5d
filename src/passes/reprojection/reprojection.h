// Where each pixel's surface was last frame: what every history of this view is fetched by.
#pragma once

#include "graph/frame_graph.h"
#include "passes/gbuffer/gbuffer.h"
#include "shaders/camera.h"

namespace lightwell {

// A texel of last frame is a valid tap of a pixel if it showed the same surface: the distance that the motion of the
// pixel's surface says, a normal within acos(0.9) = 26 degrees, the same material.
struct Reprojection {
  ImageHandle motion;  // of the G-buffer
  ImageHandle taps;  // R32UI: bits of valid taps (history_taps.glsl); none where the histories of the graph's scope are
                     // not valid
};

// Declares the pass; once a view and frame.
Reprojection record_reprojection(FrameGraph& graph, const GBuffer& gbuffer, const glsl::GpuCamera& camera);

// Binds what passes/reprojection/reprojection.glsl reads.
ComputePass& read_reprojection(ComputePass& pass, const Reprojection& reprojection);

}  // namespace lightwell
