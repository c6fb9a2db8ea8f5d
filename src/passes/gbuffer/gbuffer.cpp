#include "passes/gbuffer/gbuffer.h"

#include "kernels/passes/gbuffer/background.comp.h"
#include "kernels/passes/gbuffer/gbuffer.frag.h"
#include "kernels/passes/gbuffer/gbuffer.vert.h"
#include "passes/gbuffer/background_params.h"
#include "passes/gbuffer/gbuffer_params.h"

namespace lightwell {
namespace {

// Draws the opaque triangles on a G-buffer cleared to `background`; without one, the alpha-masked ones into what is
// there.
void draw_triangles(FrameGraph& graph, const GpuScene::Frame& scene, BufferHandle camera, GBuffer& gbuffer,
                    std::optional<glm::vec3> background) {
  const bool masked = !background;
  std::optional<VkClearColorValue> clear, clear_emission;
  if (background) {
    clear = VkClearColorValue{};
    clear_emission = VkClearColorValue{{background->r, background->g, background->b, 0.0f}};
  }
  RasterPass& pass = graph.raster(masked ? "g-buffer, alpha-masked" : "g-buffer", kernels::gbuffer_gbuffer_vert,
                                  kernels::gbuffer_gbuffer_frag, {.depth_compare = VK_COMPARE_OP_GREATER});
  pass.bind(scene.set)
      .read("previous_positions", scene.previous_positions)
      .read("camera", camera)
      .constant("kAlphaMasked", masked ? 1 : 0)
      .color(gbuffer.position, clear)
      .color(gbuffer.normal, clear)
      .color(gbuffer.albedo, clear)
      .color(gbuffer.emission, clear_emission)
      .color(gbuffer.motion, clear)
      .color(gbuffer.face, clear)
      .depth(gbuffer.depth, masked ? std::optional<float>() : 0.0f)
      .push(glsl::GBufferParams{3 * scene.opaque_triangle_count});
  if (masked) {
    pass.draw(3 * (scene.triangle_count - scene.opaque_triangle_count));
  } else {
    pass.index_buffer(scene.indices).draw(3 * scene.opaque_triangle_count);
  }
}

}  // namespace

GBuffer record_gbuffer(FrameGraph& graph, const GpuScene::Frame& scene, BufferHandle camera, ImageHandle environment,
                       std::uint32_t width, std::uint32_t height, std::optional<glm::vec3> constant_background) {
  const auto image = [&](const char* name, VkFormat format) {
    return graph.create_image(name, {.width = width, .height = height, .format = format});
  };
  GBuffer gbuffer{.position = image("position", VK_FORMAT_R32G32B32A32_SFLOAT),
                  .normal = image("normal", VK_FORMAT_R16G16B16A16_SFLOAT),
                  .albedo = image("albedo", VK_FORMAT_R16G16B16A16_SFLOAT),
                  .emission = image("emission", VK_FORMAT_R32G32B32A32_SFLOAT),
                  .motion = image("motion", VK_FORMAT_R16G16_SFLOAT),
                  .face = image("face", VK_FORMAT_R16G16B16A16_SFLOAT),
                  .depth = image("depth", VK_FORMAT_D32_SFLOAT),
                  .width = width,
                  .height = height};
  draw_triangles(graph, scene, camera, gbuffer, constant_background.value_or(glm::vec3(0.0f)));
  if (scene.opaque_triangle_count < scene.triangle_count) draw_triangles(graph, scene, camera, gbuffer, {});
  if (constant_background) return gbuffer;
  graph.compute("background", kernels::gbuffer_background_comp)
      .read("position", gbuffer.position)
      .read("environment", environment)
      .read("camera", camera)
      .write("emission", gbuffer.emission)
      .push(glsl::BackgroundParams{{width, height}})
      .dispatch_threads(width, height);
  return gbuffer;
}

}  // namespace lightwell
