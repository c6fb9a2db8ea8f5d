#include "passes/svo/svo_view.h"

#include "kernels/passes/svo/svo_view.frag.h"
#include "kernels/passes/svo/svo_view.vert.h"
#include "kernels/passes/svo/svo_view_draw.comp.h"
#include "lightwell/error.h"

namespace lightwell {

ImageHandle record_svo_view(FrameGraph& graph, const ViewFrame& view, const Svo& svo) {
  LW_ASSERT(svo.nodes, "there is no tree to show");
  const GBuffer& gbuffer = view.gbuffer;
  BufferHandle draw = graph.create_buffer("svo boxes", 4, sizeof(std::uint32_t));  // VkDrawIndirectCommand
  graph.compute("svo: view", kernels::svo_svo_view_draw_comp)
      .read("counts", svo.counts)
      .write("draw", draw)
      .dispatch(1);
  ImageHandle picture = graph.create_image(
      "svo boxes", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R16G16B16A16_SFLOAT});
  ImageHandle depth = graph.create_image(
      "svo depth", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_D32_SFLOAT});
  graph
      .raster("svo: view", kernels::svo_svo_view_vert, kernels::svo_svo_view_frag,
              {.depth_compare = VK_COMPARE_OP_GREATER})
      .bind(svo.set)
      .read("camera", view.camera_buffer)
      .color(picture, VkClearColorValue{})
      .depth(depth, 0.0f)
      .draw_indirect(draw);
  return picture;
}

}  // namespace lightwell
