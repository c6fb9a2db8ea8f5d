#include "passes/shadow_maps/atlas_layout.h"

#include <algorithm>
#include <array>
#include <vector>

namespace lightwell {
namespace {

// Places all blocks on shelves `width` texels long, highest first. Returns the height needed, more than `width` where a
// block is too long.
std::uint32_t place_on_shelves(std::span<glsl::ShadowView> views, std::uint32_t width) {
  std::vector<glsl::ShadowView*> order;
  for (glsl::ShadowView& view : views) order.push_back(&view);
  std::stable_sort(order.begin(), order.end(), [](const glsl::ShadowView* a, const glsl::ShadowView* b) {
    return block_size(*a).y > block_size(*b).y;
  });
  glm::uvec2 corner(0);
  std::uint32_t shelf = 0;  // its height
  for (glsl::ShadowView* view : order) {
    const glm::uvec2 block = block_size(*view);
    if (block.x > width) return width + 1;
    if (corner.x + block.x > width) {
      corner = {0, corner.y + shelf};
      shelf = 0;
    }
    view->tile = corner;
    corner.x += block.x;
    shelf = std::max(shelf, block.y);
  }
  return corner.y + shelf;
}

// So many lights fit for sure with the smallest tiles, whatever their kind: a cube has 3 x 2.
std::size_t count_fitting_lights(std::uint32_t atlas_side) {
  return std::size_t{atlas_side / (3 * kMinimumTileSide)} * (atlas_side / (2 * kMinimumTileSide));
}

std::uint32_t leave_out_last_lights(std::span<glsl::ShadowView> views, std::size_t most) {
  std::size_t kept = 0;
  std::uint32_t left_out = 0;
  for (glsl::ShadowView& view : views) {
    if (count_views(view) == 0 || ++kept <= most) continue;
    view.kind = glsl::kShadowNone;
    ++left_out;
  }
  return left_out;
}

}  // namespace

std::uint32_t count_views(const glsl::ShadowView& view) {
  constexpr std::array<std::uint32_t, 4> kViews{0, 1, 6, 1};
  return kViews[view.kind];
}

glm::uvec2 block_size(const glsl::ShadowView& view) {
  const std::uint32_t views = count_views(view);
  return glm::uvec2(std::min(views, 3u), (views + 2) / 3) * view.tile_side;
}

AtlasLayout lay_out_atlas(std::span<glsl::ShadowView> views, std::uint32_t atlas_side) {
  AtlasLayout layout;
  layout.lights_left_out = leave_out_last_lights(views, count_fitting_lights(atlas_side));
  std::vector<std::uint32_t> asked;
  for (const glsl::ShadowView& view : views) asked.push_back(view.tile_side);
  for (std::uint32_t divisor = 1;; divisor *= 2) {
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (count_views(views[i]) == 0) continue;
      views[i].tile_side = std::clamp(asked[i] / divisor, kMinimumTileSide, atlas_side);
      layout.shrunk = std::max(layout.shrunk, asked[i] / views[i].tile_side);
    }
    for (std::uint32_t width = 1; width <= atlas_side; width *= 2) {
      const std::uint32_t height = place_on_shelves(views, width);
      if (height > width) continue;
      layout.width = width;
      layout.height = std::max(height, 1u);
      return layout;
    }
  }
}

}  // namespace lightwell
