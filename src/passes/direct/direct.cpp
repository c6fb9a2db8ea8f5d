#include "passes/direct/direct.h"

#include "kernels/passes/direct/direct.comp.h"
#include "kernels/passes/direct/direct_rays.comp.h"
#include "passes/direct/direct_params.h"

namespace lightwell {
namespace {

// Binds what both kernels read and write, and runs the pass.
ImageHandle record(FrameGraph& graph, ComputePass& pass, const ViewFrame& view, ImageHandle sampled, float clearance) {
  const GBuffer& gbuffer = view.gbuffer;
  ImageHandle irradiance = graph.create_image(
      "direct", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
  pass.read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("sampled", sampled ? sampled : gbuffer.albedo)  // some image in its place
      .write("irradiance", irradiance)
      .push(glsl::DirectParams{{gbuffer.width, gbuffer.height}, view.world.lights.count, sampled ? 1u : 0u, clearance})
      .dispatch_threads(gbuffer.width, gbuffer.height);
  return irradiance;
}

}  // namespace

ImageHandle record_direct(FrameGraph& graph, ViewFrame& view, ImageHandle sampled) {
  const ShadowMaps::Frame& shadows = view.world.shadows();
  ComputePass& pass =
      read_lights(graph.compute("direct light", kernels::direct_direct_comp), view.world.lights, shadows);
  return record(graph, pass, view, sampled, 0.0f);
}

ImageHandle record_direct_rays(FrameGraph& graph, ViewFrame& view, ImageHandle sampled) {
  ComputePass& pass = trace_compute(graph, "direct light", kernels::direct_direct_rays_comp, view.world);
  pass.read("face", view.gbuffer.face).read("lights", view.world.lights.lights);
  return record(graph, pass, view, sampled, pixel_clearance(view.camera));
}

}  // namespace lightwell
