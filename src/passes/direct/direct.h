// Deferred direct light.
#pragma once

#include "graph/frame_graph.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/lights/light_table.h"
#include "passes/shadow_maps/shadow_maps.h"
#include "passes/trace/tracer.h"
#include "shaders/camera.h"

namespace lightwell {

// Irradiance E (W/m^2, RGBA32F, before albedo) straight from the lights at every visible surface, by shadow maps.
// `sampled`, if there is one, is added: the direct light of emitters and of the environment.
ImageHandle record_direct(FrameGraph& graph, const GBuffer& gbuffer, const LightTable::Frame& lights,
                          const ShadowMaps::Frame& shadows, ImageHandle sampled = {});

// The same by a ray to every light from every pixel. `camera`: this frame's.
ImageHandle record_direct_rays(FrameGraph& graph, const GBuffer& gbuffer, const LightTable::Frame& lights,
                               const GpuScene::Frame& scene, const Tracer::Frame& tracer, const glsl::GpuCamera& camera,
                               ImageHandle sampled = {});

}  // namespace lightwell
