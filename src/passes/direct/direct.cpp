#include "passes/direct/direct.h"

#include "kernels/passes/direct/direct.comp.h"
#include "kernels/passes/direct/direct_rays.comp.h"
#include "passes/direct/direct_params.h"

namespace lightwell {
namespace {

// Binds what both kernels read and write, and runs the pass.
ImageHandle record(FrameGraph& graph, Pass& pass, const GBuffer& gbuffer, const ShadowMaps::Frame& shadows) {
  ImageHandle irradiance = graph.create_image(
      "direct", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
  pass.read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("lights", shadows.lights)
      .write("irradiance", irradiance)
      .push(glsl::DirectParams{{gbuffer.width, gbuffer.height}, shadows.light_count})
      .dispatch_threads(gbuffer.width, gbuffer.height);
  return irradiance;
}

}  // namespace

ImageHandle record_direct(FrameGraph& graph, const GBuffer& gbuffer, const ShadowMaps::Frame& shadows) {
  Pass& pass = graph.compute("direct light", kernels::direct_direct_comp).read("shadow_atlas", shadows.atlas);
  return record(graph, pass, gbuffer, shadows);
}

ImageHandle record_direct_rays(FrameGraph& graph, const GBuffer& gbuffer, const ShadowMaps::Frame& shadows,
                               const GpuScene::Frame& scene, const Tracer::Frame& tracer) {
  return record(graph, trace_compute(graph, "direct light", kernels::direct_direct_rays_comp, scene, tracer), gbuffer,
                shadows);
}

}  // namespace lightwell
