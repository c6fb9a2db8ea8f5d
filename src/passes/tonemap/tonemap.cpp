#include "passes/tonemap/tonemap.h"

#include "kernels/passes/tonemap/tonemap.frag.h"
#include "kernels/passes/tonemap/tonemap.vert.h"
#include "passes/tonemap/tonemap_params.h"

namespace lightwell {

void record_tonemap(FrameGraph& graph, ImageHandle radiance, float exposure, ImageHandle& target) {
  const VkFormat format = graph.desc(target).format;
  const bool encodes = format == VK_FORMAT_R8G8B8A8_SRGB || format == VK_FORMAT_B8G8R8A8_SRGB;
  graph.raster("tone map", kernels::tonemap_tonemap_vert, kernels::tonemap_tonemap_frag, {})
      .read("radiance", radiance)
      .push(glsl::TonemapParams{exposure, encodes ? 0u : 1u})
      .color(target, VkClearColorValue{})
      .draw(3);
}

}  // namespace lightwell
