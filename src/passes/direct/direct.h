// Deferred direct light.
#pragma once

#include "graph/frame_graph.h"
#include "passes/view/view_frame.h"

namespace lightwell {

// Irradiance E (W/m^2, RGBA32F, before albedo) straight from the lights at every visible surface, by shadow maps.
// `sampled`, if there is one, is added: the direct light of emitters and of the environment.
ImageHandle record_direct(FrameGraph& graph, ViewFrame& view, ImageHandle sampled = {});

// The same by a ray to every light from every pixel.
ImageHandle record_direct_rays(FrameGraph& graph, ViewFrame& view, ImageHandle sampled = {});

}  // namespace lightwell
