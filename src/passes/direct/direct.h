// Deferred direct light.
#pragma once

#include "graph/frame_graph.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/shadow_maps/shadow_maps.h"

namespace lightwell {

// Irradiance E (W/m^2, RGBA32F, before albedo) straight from the lights at every visible surface.
ImageHandle record_direct(FrameGraph& graph, const GBuffer& gbuffer, const ShadowMaps::Frame& shadows);

}  // namespace lightwell
