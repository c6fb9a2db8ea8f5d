#include "passes/direct/direct.h"

#include "kernels/passes/direct/direct.comp.h"
#include "passes/direct/direct_params.h"

namespace lightwell {

ImageHandle record_direct(FrameGraph& graph, const GBuffer& gbuffer, const ShadowMaps::Frame& shadows) {
  ImageHandle irradiance = graph.create_image(
      "direct", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
  graph.compute("direct light", kernels::direct_direct_comp)
      .read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("lights", shadows.lights)
      .read("shadow_atlas", shadows.atlas)
      .write("irradiance", irradiance)
      .push(glsl::DirectParams{{gbuffer.width, gbuffer.height}, shadows.light_count})
      .dispatch_threads(gbuffer.width, gbuffer.height);
  return irradiance;
}

}  // namespace lightwell
