#include "passes/shadow_maps/shadow_maps.h"

#include <cstring>

#include "kernels/passes/shadow_maps/shadow.frag.h"
#include "kernels/passes/shadow_maps/shadow.vert.h"
#include "kernels/passes/shadow_maps/shadow_holes.frag.h"
#include "kernels/passes/shadow_maps/shadow_holes.vert.h"
#include "passes/shadow_maps/light_views.h"
#include "passes/shadow_maps/shadow_params.h"

namespace lightwell {
namespace {

// Every view of every light is one draw into its own tile.
void draw_views(RasterPass& pass, const LightViews& views, std::uint32_t first_index, std::uint32_t index_count) {
  for (std::uint32_t light = 0; light < views.lights.size(); ++light) {
    const glsl::GpuLight& view = views.lights[light];
    const std::uint32_t side = view.tile_side;
    for (std::uint32_t face = 0; face < count_views(view); ++face) {
      const VkRect2D area{{static_cast<std::int32_t>(view.tile.x + face % 3 * side),
                           static_cast<std::int32_t>(view.tile.y + face / 3 * side)},
                          {side, side}};
      pass.draw_in(area, glsl::ShadowParams{light, face, first_index}, index_count);
    }
  }
}

constexpr RasterState kNearestWins{.depth_compare = VK_COMPARE_OP_GREATER};

void draw_opaque_triangles(FrameGraph& graph, const GpuScene::Frame& scene, const LightViews& views,
                           BufferHandle lights, ImageHandle& atlas) {
  RasterPass& pass =
      graph.raster("shadow maps", kernels::shadow_maps_shadow_vert, kernels::shadow_maps_shadow_frag, kNearestWins);
  pass.bind(scene.set).read("lights", lights).index_buffer(scene.indices).depth(atlas, 0.0f);
  draw_views(pass, views, 0, 3 * scene.opaque_triangle_count);
}

void draw_triangles_with_holes(FrameGraph& graph, const GpuScene::Frame& scene, const LightViews& views,
                               BufferHandle lights, ImageHandle& atlas) {
  RasterPass& pass = graph.raster("shadow maps holes", kernels::shadow_maps_shadow_holes_vert,
                                  kernels::shadow_maps_shadow_holes_frag, kNearestWins);
  pass.bind(scene.set).read("lights", lights).depth(atlas, std::nullopt);
  draw_views(pass, views, 3 * scene.opaque_triangle_count, 3 * (scene.triangle_count - scene.opaque_triangle_count));
}

}  // namespace

ShadowMaps::Frame ShadowMaps::record(FrameGraph& graph, const GpuScene::Frame& scene, const SceneSnapshot& world,
                                     const Bounds& focus, std::uint32_t tile_side) {
  const LightViews views = make_light_views(world.lights, world.bounds, focus, tile_side);
  Frame frame;
  frame.lights = graph.upload<glsl::GpuLight>("lights", views.lights);
  frame.light_count = static_cast<std::uint32_t>(views.lights.size());
  bool fresh = false;
  frame.atlas = graph.history_image(
      "shadow atlas", {.width = views.atlas_width, .height = views.atlas_height, .format = VK_FORMAT_D32_SFLOAT},
      fresh);
  const bool same_lights = drawn_lights_.size() == views.lights.size() &&
                           (views.lights.empty() || std::memcmp(drawn_lights_.data(), views.lights.data(),
                                                                views.lights.size() * sizeof(glsl::GpuLight)) == 0);
  if (fresh || !same_lights || surfaces_changed(drawn_revisions_, scene.revisions)) {
    draw_opaque_triangles(graph, scene, views, frame.lights, frame.atlas);
    if (scene.opaque_triangle_count < scene.triangle_count) {
      draw_triangles_with_holes(graph, scene, views, frame.lights, frame.atlas);
    }
    graph.on_recorded([this, lights = views.lights, revisions = scene.revisions] {
      drawn_lights_ = lights;
      drawn_revisions_ = revisions;
    });
  }
  return frame;
}

}  // namespace lightwell
