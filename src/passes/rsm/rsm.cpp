#include "passes/rsm/rsm.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include <glm/common.hpp>

#include "kernels/passes/rsm/rsm.frag.h"
#include "kernels/passes/rsm/rsm.vert.h"
#include "kernels/passes/rsm/rsm_clear.frag.h"
#include "kernels/passes/rsm/rsm_mips.comp.h"
#include "kernels/passes/rsm/rsm_powers.comp.h"
#include "kernels/passes/shadow_maps/shadow_clear.vert.h"
#include "passes/rsm/rsm_mips_params.h"
#include "passes/rsm/rsm_params.h"
#include "passes/rsm/rsm_powers_params.h"
#include "passes/shadow_maps/shadow_views.h"
#include "passes/shadow_maps/visible_parts.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kMaximumSide = 2048;  // of the atlas, texels: 240 MiB
constexpr std::uint32_t kLargestTileSide = 1024;
constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkClearColorValue kNothing{};

using LightList = std::vector<std::uint32_t>;

bool is_finite(const Bounds& bounds) {
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(bounds.minimum[axis]) || !std::isfinite(bounds.maximum[axis])) return false;
  return true;
}

VkRect2D make_rect(const glm::uvec2& corner, const glm::uvec2& size) {
  return {{static_cast<std::int32_t>(corner.x), static_cast<std::int32_t>(corner.y)}, {size.x, size.y}};
}

// The atlas while it is drawn.
struct Atlas {
  ReflectiveShadowMaps::Frame& maps;
  ImageHandle depth;
  std::uint32_t width;
  std::uint32_t height;
};

// Tiles of lights whose neighbours keep theirs.
void clear_tiles(FrameGraph& graph, const std::vector<glsl::ShadowView>& views, const LightList& lights, Atlas& atlas) {
  RasterPass& pass = graph.raster("rsm: clear", kernels::shadow_maps_shadow_clear_vert, kernels::rsm_rsm_clear_frag,
                                  {.depth_compare = VK_COMPARE_OP_ALWAYS});
  pass.color(atlas.maps.position, std::nullopt)
      .color(atlas.maps.normal, std::nullopt)
      .color(atlas.maps.flux, std::nullopt);
  for (const std::uint32_t light : lights)
    pass.draw(DrawCall{.count = 3, .viewport = make_rect(views[light].tile, block_size(views[light]))});
}

// What the lights' views may see, opaque or alpha-masked, each in its own tile. Reversed depth.
void draw_views(FrameGraph& graph, const WorldFrame& world, const std::vector<glsl::ShadowView>& views,
                const LightList& lights, bool alpha_masked, bool clears_color, Atlas& atlas) {
  const std::optional<VkClearColorValue> clear = clears_color ? std::optional(kNothing) : std::nullopt;
  RasterPass& pass = graph.raster(alpha_masked ? "rsm: alpha-masked" : "rsm: opaque", kernels::rsm_rsm_vert,
                                  kernels::rsm_rsm_frag, {.depth_compare = VK_COMPARE_OP_GREATER});
  pass.bind(world.scene.set)
      .read("views", atlas.maps.views)
      .read("lights", world.lights.lights)
      .constant("kAlphaMasked", alpha_masked ? 1 : 0)
      .color(atlas.maps.position, clear)
      .color(atlas.maps.normal, clear)
      .color(atlas.maps.flux, clear)
      .depth(atlas.depth, alpha_masked ? std::optional<float>() : 0.0f);
  if (!alpha_masked) pass.index_buffer(world.scene.indices);
  for (const std::uint32_t light : lights) {
    const glsl::ShadowView& view = views[light];
    for (std::uint32_t face = 0; face < count_views(view); ++face) {
      const glm::uvec2 corner = view.tile + view.tile_side * glm::uvec2(face % 3, face / 3);
      for (const IndexRange& range : list_visible_ranges(world.scene.parts, alpha_masked, view, face))
        pass.draw_in(make_rect(corner, glm::uvec2(view.tile_side)), glsl::RsmParams{light, face}, range.count,
                     range.first);
    }
  }
}

void sum_luminances(FrameGraph& graph, Atlas& atlas) {
  ReflectiveShadowMaps::Frame& maps = atlas.maps;
  for (std::uint32_t level = 0; level <= maps.top_level; ++level) {
    const glsl::RsmMipsParams params{{atlas.width >> level, atlas.height >> level}};
    ComputePass& pass = graph.compute("rsm: luminances", kernels::rsm_rsm_mips_comp)
                            .constant("kFinest", level == 0 ? 1 : 0)
                            .push(params);
    if (level == 0)
      pass.read("source", maps.flux);
    else
      pass.read("source", maps.luminances, SamplerKind::kNearestClamp, mip_of(level - 1));
    pass.write("target", maps.luminances, mip_of(level)).dispatch_threads(params.size.x, params.size.y);
  }
}

}  // namespace

Bounds finite_bounds(const WorldFrame& world) {
  if (is_finite(world.snapshot.bounds)) return world.snapshot.bounds;
  std::optional<Bounds> all;
  for (const PartRange& part : world.scene.parts) {
    if (!is_finite(part.world_bounds)) continue;
    if (!all) all = part.world_bounds;
    all->minimum = glm::min(all->minimum, part.world_bounds.minimum);
    all->maximum = glm::max(all->maximum, part.world_bounds.maximum);
  }
  return all.value_or(Bounds{});
}

std::vector<std::uint32_t> ReflectiveShadowMaps::list_changed(const std::vector<Drawn>& now) const {
  LightList changed;
  for (std::uint32_t i = 0; i < now.size(); ++i) {
    if (now[i].view.kind == glsl::kShadowNone) continue;
    if (i >= drawn_.size() || drawn_[i].revision != now[i].revision ||
        std::memcmp(&drawn_[i].view, &now[i].view, sizeof(glsl::ShadowView)) != 0)
      changed.push_back(i);
  }
  return changed;
}

ReflectiveShadowMaps::Frame ReflectiveShadowMaps::record(FrameGraph& graph, const WorldFrame& world,
                                                         const Settings& settings) {
  const std::uint32_t asked =
      std::bit_floor(std::clamp(settings.tile_side, kMinimumTileSide, std::min(kLargestTileSide, kMaximumSide / 4)));
  const Bounds bounds = finite_bounds(world);
  const ShadowViews made =
      make_shadow_views(world.lights.world, bounds, {}, asked, kMaximumSide, {.guard = 0, .whole_scene_factor = 1});
  std::vector<Drawn> now;
  LightList all;
  for (std::uint32_t i = 0; i < made.views.size(); ++i) {
    now.push_back({made.views[i], world.lights.revisions[i]});
    if (made.views[i].kind != glsl::kShadowNone) all.push_back(i);
  }
  if (all.empty()) return {};

  Frame frame;
  frame.top_level = static_cast<std::uint32_t>(std::countr_zero(made.views[all.front()].tile_side));
  frame.light_count = static_cast<std::uint32_t>(all.size());
  frame.views = graph.upload<glsl::ShadowView>("rsm views", made.views);
  const ImageDesc desc{.width = made.atlas.width, .height = made.atlas.height, .format = kFormat};
  bool fresh[4];
  frame.position = graph.history_image("rsm position", desc, fresh[0]);
  frame.normal = graph.history_image("rsm normal", desc, fresh[1]);
  frame.flux = graph.history_image("rsm flux", desc, fresh[2]);
  frame.luminances = graph.history_image("rsm luminances",
                                         {.width = made.atlas.width,
                                          .height = made.atlas.height,
                                          .mips = frame.top_level + 1,
                                          .format = VK_FORMAT_R32_SFLOAT},
                                         fresh[3]);
  const bool redraw =
      fresh[0] || fresh[1] || fresh[2] || fresh[3] || surfaces_changed(drawn_revisions_, world.revisions);
  const LightList changed = redraw ? all : list_changed(now);
  if (!changed.empty()) {
    Atlas atlas{frame, {}, made.atlas.width, made.atlas.height};
    atlas.depth =
        graph.create_image("rsm depth", {.width = atlas.width, .height = atlas.height, .format = VK_FORMAT_D32_SFLOAT});
    const bool clears = changed.size() == all.size();
    if (!clears) clear_tiles(graph, made.views, changed, atlas);
    draw_views(graph, world, made.views, changed, false, clears, atlas);
    if (world.scene.opaque_triangle_count < world.scene.triangle_count)
      draw_views(graph, world, made.views, changed, true, false, atlas);
    sum_luminances(graph, atlas);
  }
  const glsl::RsmPowersParams params{world.lights.count, frame.top_level};
  frame.powers = graph.create_buffer("rsm powers", world.lights.count, sizeof(float));
  graph.compute("rsm: powers", kernels::rsm_rsm_powers_comp)
      .read("views", frame.views)
      .read("luminances", frame.luminances)
      .write("powers", frame.powers)
      .push(params)
      .dispatch_threads(world.lights.count);
  graph.on_recorded([this, now = std::move(now), revisions = world.revisions] {
    drawn_ = now;
    drawn_revisions_ = revisions;
  });
  return frame;
}

}  // namespace lightwell
