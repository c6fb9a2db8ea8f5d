#include <algorithm>

#include "kernels/passes/light_paths/light_point_dim.comp.h"
#include "kernels/passes/light_paths/light_point_view.frag.h"
#include "kernels/passes/light_paths/light_point_view.vert.h"
#include "passes/light_paths/light_paths.h"
#include "passes/light_paths/light_point_view_params.h"

namespace lightwell {

ImageHandle record_light_point_view(FrameGraph& graph, const ViewFrame& view, BufferHandle points, std::uint32_t count,
                                    LightPointColor color) {
  const GBuffer& gbuffer = view.gbuffer;
  ImageHandle picture = graph.create_image(
      "light points", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R16G16B16A16_SFLOAT});
  ImageHandle depth = graph.create_image(
      "light point depth", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_D32_SFLOAT});
  graph.compute("light paths: dim picture", kernels::light_paths_light_point_dim_comp)
      .read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("albedo", gbuffer.albedo)
      .read("camera", view.camera_buffer)
      .write("picture", picture)
      .dispatch_threads(gbuffer.width, gbuffer.height);
  graph
      .raster("light paths: points", kernels::light_paths_light_point_view_vert,
              kernels::light_paths_light_point_view_frag, {.depth_compare = VK_COMPARE_OP_GREATER})
      .read("points", points)
      .read("camera", view.camera_buffer)
      .read("surface_position", gbuffer.position)
      .color(picture, std::nullopt)
      .depth(depth, 0.0f)
      .push(glsl::LightPointViewParams{std::max(1.5f, static_cast<float>(gbuffer.height) / 160.0f),
                                       color == LightPointColor::kBounce ? 1u : 0u})
      .draw(6, count);
  return picture;
}

}  // namespace lightwell
