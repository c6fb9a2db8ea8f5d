// Deferred direct light.
#pragma once

#include "graph/frame_graph.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/shadow_maps/shadow_maps.h"
#include "passes/trace/tracer.h"

namespace lightwell {

// Irradiance E (W/m^2, RGBA32F, before albedo) straight from the lights at every visible surface.
ImageHandle record_direct(FrameGraph& graph, const GBuffer& gbuffer, const ShadowMaps::Frame& shadows);

// The same by a shadow ray to every light from every pixel.
ImageHandle record_direct_rays(FrameGraph& graph, const GBuffer& gbuffer, const ShadowMaps::Frame& shadows,
                               const GpuScene::Frame& scene, const Tracer::Frame& tracer);

}  // namespace lightwell
