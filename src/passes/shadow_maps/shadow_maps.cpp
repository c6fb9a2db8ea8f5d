#include "passes/shadow_maps/shadow_maps.h"

#include <cstring>

#include "kernels/passes/shadow_maps/shadow.frag.h"
#include "kernels/passes/shadow_maps/shadow.vert.h"
#include "kernels/passes/shadow_maps/shadow_masked.frag.h"
#include "kernels/passes/shadow_maps/shadow_masked.vert.h"
#include "passes/shadow_maps/light_views.h"
#include "passes/shadow_maps/shadow_params.h"

namespace lightwell {
namespace {

// Every view of every light is one draw into its own tile.
void draw_views(FrameGraph& graph, const GpuScene::Frame& scene, const LightViews& views, BufferHandle lights,
                ImageHandle& atlas) {
  const RasterState state{.depth_compare = VK_COMPARE_OP_GREATER};
  Pass& pass = scene.has_holes ? graph.raster("shadow maps", kernels::shadow_maps_shadow_masked_vert,
                                              kernels::shadow_maps_shadow_masked_frag, state)
                               : graph.raster("shadow maps", kernels::shadow_maps_shadow_vert,
                                              kernels::shadow_maps_shadow_frag, state);
  pass.read("vertices", scene.vertices).read("lights", lights).index_buffer(scene.indices).depth(atlas, 0.0f);
  if (scene.has_holes) {
    pass.read("materials", scene.materials)
        .read("textures_0", scene.textures[0], SamplerKind::kLinearRepeat)
        .read("textures_1", scene.textures[1], SamplerKind::kLinearRepeat)
        .read("textures_2", scene.textures[2], SamplerKind::kLinearRepeat)
        .read("textures_3", scene.textures[3], SamplerKind::kLinearRepeat);
  }
  const std::uint32_t side = views.tile_side;
  for (std::uint32_t light = 0; light < views.lights.size(); ++light) {
    const glsl::GpuLight& view = views.lights[light];
    if (view.shadow_kind == glsl::kShadowNone) continue;
    const std::uint32_t faces = view.shadow_kind == glsl::kShadowCube ? 6 : 1;
    for (std::uint32_t face = 0; face < faces; ++face) {
      const std::uint32_t tile = view.first_tile + face;
      const VkRect2D area{{static_cast<std::int32_t>(tile % views.columns * side),
                           static_cast<std::int32_t>(tile / views.columns * side)},
                          {side, side}};
      pass.draw_in(area, glsl::ShadowParams{light, face}, 3 * scene.triangle_count);
    }
  }
}

}  // namespace

ShadowMaps::Frame ShadowMaps::record(FrameGraph& graph, const GpuScene::Frame& scene, const SceneSnapshot& world,
                                     const Bounds& focus, std::uint32_t tile_side) {
  const LightViews views = make_light_views(world.lights, world.bounds, focus, tile_side);
  Frame frame;
  frame.lights = graph.upload<glsl::GpuLight>("lights", views.lights);
  frame.light_count = static_cast<std::uint32_t>(views.lights.size());
  bool fresh = false;
  frame.atlas = graph.history_image("shadow atlas",
                                    {.width = views.columns * views.tile_side,
                                     .height = views.rows * views.tile_side,
                                     .format = VK_FORMAT_D32_SFLOAT},
                                    fresh);
  const bool same_lights =
      drawn_lights_.size() == views.lights.size() &&
      (views.lights.empty() ||
       std::memcmp(drawn_lights_.data(), views.lights.data(), views.lights.size() * sizeof(glsl::GpuLight)) == 0);
  if (fresh || !same_lights || drawn_revision_ != scene.revision) {
    draw_views(graph, scene, views, frame.lights, frame.atlas);
    drawn_lights_ = views.lights;
    drawn_revision_ = scene.revision;
  }
  return frame;
}

}  // namespace lightwell
