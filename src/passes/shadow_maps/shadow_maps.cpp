#include "passes/shadow_maps/shadow_maps.h"

#include <algorithm>
#include <bit>
#include <string>
#include <tuple>
#include <utility>

#include "core/log.h"
#include "gpu/device.h"
#include "kernels/passes/shadow_maps/shadow.frag.h"
#include "kernels/passes/shadow_maps/shadow.vert.h"
#include "kernels/passes/shadow_maps/shadow_clear.vert.h"
#include "kernels/passes/shadow_maps/shadow_masked.frag.h"
#include "kernels/passes/shadow_maps/shadow_masked.vert.h"
#include "passes/shadow_maps/shadow_params.h"
#include "passes/shadow_maps/shadow_views.h"
#include "passes/shadow_maps/visible_parts.h"

namespace lightwell {
namespace {

using ViewList = std::vector<std::uint32_t>;

bool same_view(const glsl::ShadowView& a, const glsl::ShadowView& b) {
  return std::tie(a.kind, a.tile, a.tile_side, a.to_shadow, a.position, a.texel_size) ==
         std::tie(b.kind, b.tile, b.tile_side, b.to_shadow, b.position, b.texel_size);
}

VkRect2D make_rect(const glm::uvec2& corner, const glm::uvec2& size) {
  return {{static_cast<std::int32_t>(corner.x), static_cast<std::int32_t>(corner.y)}, {size.x, size.y}};
}

// What one view after another may see, each in its own tile.
void draw_views(RasterPass& pass, const GpuScene::Frame& scene, const std::vector<glsl::ShadowView>& views,
                const ViewList& list, bool alpha_masked) {
  for (const std::uint32_t index : list) {
    const glsl::ShadowView& view = views[index];
    for (std::uint32_t face = 0; face < count_views(view); ++face) {
      const glm::uvec2 corner = view.tile + view.tile_side * glm::uvec2(face % 3, face / 3);
      const VkRect2D area = make_rect(corner, glm::uvec2(view.tile_side));
      for (const IndexRange& range : list_visible_ranges(scene.parts, alpha_masked, view, face))
        pass.draw_in(area, glsl::ShadowParams{index, face}, range.count, range.first);
    }
  }
}

constexpr RasterState kNearestWins{.depth_compare = VK_COMPARE_OP_GREATER};
constexpr RasterState kLastWins{.depth_compare = VK_COMPARE_OP_ALWAYS};

// Tiles whose neighbours stay as they are.
void clear_tiles(FrameGraph& graph, const std::vector<glsl::ShadowView>& views, const ViewList& list,
                 ImageHandle& atlas) {
  RasterPass& pass = graph.raster("clear shadow maps", kernels::shadow_maps_shadow_clear_vert,
                                  kernels::shadow_maps_shadow_frag, kLastWins);
  pass.depth(atlas, std::nullopt);
  for (const std::uint32_t index : list) {
    const VkRect2D area = make_rect(views[index].tile, block_size(views[index]));
    pass.draw(DrawCall{.count = 3, .viewport = area});
  }
}

void draw_opaque_triangles(FrameGraph& graph, const GpuScene::Frame& scene, const ShadowViews& views,
                           const ViewList& list, std::optional<float> clear, ShadowMaps::Frame& frame) {
  RasterPass& pass =
      graph.raster("shadow maps", kernels::shadow_maps_shadow_vert, kernels::shadow_maps_shadow_frag, kNearestWins);
  pass.bind(scene.set).read("shadow_views", frame.views).index_buffer(scene.indices).depth(frame.atlas, clear);
  draw_views(pass, scene, views.views, list, false);
}

void draw_masked_triangles(FrameGraph& graph, const GpuScene::Frame& scene, const ShadowViews& views,
                           const ViewList& list, ShadowMaps::Frame& frame) {
  RasterPass& pass = graph.raster("shadow maps, alpha-masked", kernels::shadow_maps_shadow_masked_vert,
                                  kernels::shadow_maps_shadow_masked_frag, kNearestWins);
  pass.bind(scene.set).read("shadow_views", frame.views).depth(frame.atlas, std::nullopt);
  draw_views(pass, scene, views.views, list, true);
}

// Views that are not those of `drawn`.
ViewList list_changed(const std::vector<glsl::ShadowView>& views, const std::vector<glsl::ShadowView>& drawn) {
  ViewList changed;
  for (std::uint32_t i = 0; i < views.size(); ++i)
    if (count_views(views[i]) > 0 && (i >= drawn.size() || !same_view(views[i], drawn[i]))) changed.push_back(i);
  return changed;
}

std::string times(std::uint32_t side) {
  return std::to_string(side) + " x " + std::to_string(side);
}

}  // namespace

ShadowMaps::ShadowMaps(const Device& device)
    : atlas_side_(std::bit_floor(std::min(kMaximumAtlasSide, device.limits().maxImageDimension2D))) {}

void ShadowMaps::warn(const AtlasLayout& layout) {
  if (warned_ || (layout.shrunk == 1 && layout.lights_left_out == 0)) return;
  warned_ = true;
  std::string message = "the shadow maps of all lights do not fit in " + times(atlas_side_) + " texels: some have 1/" +
                        std::to_string(layout.shrunk) + " of the texels a side that shadow_map_size asks for";
  if (layout.lights_left_out > 0)
    message += ", and the last " + std::to_string(layout.lights_left_out) + " lights cast no shadows";
  log_warning(message);
}

ShadowMaps::Frame ShadowMaps::record(FrameGraph& graph, const GpuScene::Frame& scene, const LightTable::Frame& lights,
                                     const Bounds& bounds, std::span<const FocusBall> balls, std::uint32_t tile_side) {
  ShadowViews views = make_shadow_views(lights.world, bounds, balls, tile_side, atlas_side_);
  warn(views.atlas);
  Frame frame;
  frame.views = graph.upload<glsl::ShadowView>("shadow views", views.views);
  bool fresh = false;
  frame.atlas = graph.history_image(
      "shadow atlas", {.width = views.atlas.width, .height = views.atlas.height, .format = VK_FORMAT_D32_SFLOAT},
      fresh);
  const bool redraw = fresh || surfaces_changed(drawn_revisions_, scene.revisions);
  const ViewList all = list_changed(views.views, {});
  const ViewList changed = redraw ? all : list_changed(views.views, drawn_views_);
  if (redraw || !changed.empty()) {
    const bool clears = changed.size() == all.size();
    if (!clears) clear_tiles(graph, views.views, changed, frame.atlas);
    draw_opaque_triangles(graph, scene, views, changed, clears ? std::optional(0.0f) : std::nullopt, frame);
    if (scene.opaque_triangle_count < scene.triangle_count) draw_masked_triangles(graph, scene, views, changed, frame);
  }
  graph.on_recorded([this, drawn = std::move(views.views), revisions = scene.revisions] {
    drawn_views_ = drawn;
    drawn_revisions_ = revisions;
  });
  return frame;
}

}  // namespace lightwell
