#include "passes/direct/direct.h"

#include "kernels/passes/direct/direct.comp.h"
#include "kernels/passes/direct/direct_rays.comp.h"
#include "passes/camera/camera.h"
#include "passes/direct/direct_params.h"

namespace lightwell {
namespace {

// Binds what both kernels read and write, and runs the pass.
ImageHandle record(FrameGraph& graph, ComputePass& pass, const GBuffer& gbuffer, std::uint32_t light_count,
                   ImageHandle sampled, float clearance) {
  ImageHandle irradiance = graph.create_image(
      "direct", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
  pass.read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("sampled", sampled ? sampled : gbuffer.albedo)  // some image in its place
      .write("irradiance", irradiance)
      .push(glsl::DirectParams{{gbuffer.width, gbuffer.height}, light_count, sampled ? 1u : 0u, clearance})
      .dispatch_threads(gbuffer.width, gbuffer.height);
  return irradiance;
}

}  // namespace

ImageHandle record_direct(FrameGraph& graph, const GBuffer& gbuffer, const LightTable::Frame& lights,
                          const ShadowMaps::Frame& shadows, ImageHandle sampled) {
  ComputePass& pass = read_lights(graph.compute("direct light", kernels::direct_direct_comp), lights, shadows);
  return record(graph, pass, gbuffer, lights.count, sampled, 0.0f);
}

ImageHandle record_direct_rays(FrameGraph& graph, const GBuffer& gbuffer, const LightTable::Frame& lights,
                               const GpuScene::Frame& scene, const Tracer::Frame& tracer, const glsl::GpuCamera& camera,
                               ImageHandle sampled) {
  ComputePass& pass = trace_compute(graph, "direct light", kernels::direct_direct_rays_comp, scene, tracer);
  pass.read("face", gbuffer.face).read("lights", lights.lights);
  return record(graph, pass, gbuffer, lights.count, sampled, pixel_clearance(camera));
}

}  // namespace lightwell
