#include "passes/shadow_maps/light_views.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lightwell {
namespace {

constexpr float kWidestSingleView = 1.0471976f;  // radians from the axis: wider spots get a cube

struct Basis {
  glm::vec3 right;
  glm::vec3 up;
};

// Two unit vectors perpendicular to `forward`.
Basis make_basis(const glm::vec3& forward) {
  const glm::vec3 helper = std::abs(forward.y) > 0.9f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
  const glm::vec3 right = glm::normalize(glm::cross(forward, helper));
  return {right, glm::cross(right, forward)};
}

// Row `row` of a matrix: dot(axis, p) * scale + offset.
void set_row(glm::mat4& matrix, int row, const glm::vec3& axis, float scale, float offset) {
  for (int column = 0; column < 3; ++column) matrix[column][row] = axis[column] * scale;
  matrix[3][row] = offset;
}

// m; of scenes without extent, what single precision tells apart where they are.
float scene_size(const Bounds& bounds) {
  const float farthest = std::max(glm::length(bounds.minimum), glm::length(bounds.maximum));
  return std::max({glm::length(bounds.maximum - bounds.minimum), 1e-5f * farthest, 1e-9f});
}

std::uint32_t shadow_kind(const WorldLight& light, bool nested) {
  if (light.type == LightType::kPoint) return glsl::kShadowCube;
  if (light.type == LightType::kDirectional && nested) return glsl::kShadowNested;
  if (light.type == LightType::kSpot && std::acos(light.cos_outer) > kWidestSingleView) return glsl::kShadowCube;
  return glsl::kShadowSingle;
}

// How much wider than needed a view is, so that its guard texels lie outside of what is needed.
float guard_factor(std::uint32_t tile_side) {
  return static_cast<float>(tile_side) / static_cast<float>(tile_side - 2 * glsl::kShadowGuard);
}

// Nearest distance that a point or spot light's shadow maps see.
float near_distance(const Bounds& bounds) {
  return 5e-4f * scene_size(bounds);
}

void set_cube_view(glsl::GpuLight& out, float near) {
  const float half = guard_factor(out.tile_side);  // tangent of 45 degrees is 1
  out.to_shadow = glm::mat4(0.0f);
  out.to_shadow[0][0] = 1.0f / half;
  out.to_shadow[1][1] = 1.0f / half;
  out.to_shadow[2][3] = 1.0f;
  out.to_shadow[3][2] = near;
  out.texel_size = 2.0f * half / static_cast<float>(out.tile_side);
}

void set_spot_view(glsl::GpuLight& out, float near) {
  const float half = std::tan(std::max(std::acos(out.cos_outer), 0.01f)) * guard_factor(out.tile_side);
  const Basis basis = make_basis(out.direction);
  out.to_shadow = glm::mat4(0.0f);
  set_row(out.to_shadow, 0, basis.right, 1.0f / half, -glm::dot(basis.right, out.position) / half);
  set_row(out.to_shadow, 1, basis.up, 1.0f / half, -glm::dot(basis.up, out.position) / half);
  set_row(out.to_shadow, 3, out.direction, 1.0f, -glm::dot(out.direction, out.position));
  out.to_shadow[3][2] = near;
  out.texel_size = 2.0f * half / static_cast<float>(out.tile_side);
}

struct Interval {
  float minimum = INFINITY;
  float maximum = -INFINITY;
};

Interval project(const Bounds& bounds, const glm::vec3& axis) {
  Interval interval;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 point((corner & 1) != 0 ? bounds.maximum.x : bounds.minimum.x,
                          (corner & 2) != 0 ? bounds.maximum.y : bounds.minimum.y,
                          (corner & 4) != 0 ? bounds.maximum.z : bounds.minimum.z);
    interval.minimum = std::min(interval.minimum, glm::dot(axis, point));
    interval.maximum = std::max(interval.maximum, glm::dot(axis, point));
  }
  return interval;
}

// One axis across a directional view: from metres along it to NDC.
struct Fit {
  float scale;
  float offset;
};

// One axis across a directional view. Texel size moves in steps of 2^(1/8) and the origin in whole texels, so that
// shadows of what stands still do not crawl while the bounds change.
Fit fit_axis(const glm::vec3& axis, const Bounds& bounds, std::uint32_t tile_side) {
  const Interval range = project(bounds, axis);
  const auto inner = static_cast<float>(tile_side - 4 * glsl::kShadowGuard);
  const float needed = std::max(range.maximum - range.minimum, 1e-5f * scene_size(bounds)) / inner;
  const float texel = std::exp2(std::ceil(std::log2(needed) * 8.0f) / 8.0f);
  const float center = std::round(0.5f * (range.minimum + range.maximum) / texel) * texel;
  const float half = 0.5f * texel * static_cast<float>(tile_side);
  return {1.0f / half, -center / half};
}

void set_directional_view(glsl::GpuLight& out, const Bounds& bounds, const Bounds& focus) {
  const Basis basis = make_basis(out.direction);
  out.to_shadow = glm::mat4(0.0f);
  const Bounds& fine = out.shadow_kind == glsl::kShadowNested ? focus : bounds;
  const Fit x = fit_axis(basis.right, fine, out.tile_side);
  const Fit y = fit_axis(basis.up, fine, out.tile_side);
  set_row(out.to_shadow, 0, basis.right, x.scale, x.offset);
  set_row(out.to_shadow, 1, basis.up, y.scale, y.offset);
  out.texel_size = 2.0f / (std::min(x.scale, y.scale) * static_cast<float>(out.tile_side));
  const Fit coarse_x = fit_axis(basis.right, bounds, out.tile_side);
  const Fit coarse_y = fit_axis(basis.up, bounds, out.tile_side);
  const glm::vec2 ratio(coarse_x.scale / x.scale, coarse_y.scale / y.scale);
  out.coarse = {ratio.x, ratio.y, coarse_x.offset - ratio.x * x.offset, coarse_y.offset - ratio.y * y.offset};

  // Reversed depth: 1 where the scene begins, 0 where it ends, with room for flat scenes.
  const Interval range = project(bounds, out.direction);
  const float margin = 1e-3f * (range.maximum - range.minimum) + 1e-4f * scene_size(bounds);
  const float depth = range.maximum - range.minimum + 2.0f * margin;
  set_row(out.to_shadow, 2, out.direction, -1.0f / depth, (range.maximum + margin) / depth);
  out.to_shadow[3][3] = 1.0f;
}

// Texels that a light's views take in the atlas.
glm::uvec2 block_size(const glsl::GpuLight& light) {
  const std::uint32_t views = count_views(light);
  return glm::uvec2(std::min(views, 3u), (views + 2) / 3) * light.tile_side;
}

// Places all blocks on shelves `width` texels long, highest first; returns the height needed.
std::uint32_t place_on_shelves(std::vector<glsl::GpuLight>& lights, std::uint32_t width) {
  std::vector<glsl::GpuLight*> order;
  for (glsl::GpuLight& light : lights) order.push_back(&light);
  std::stable_sort(order.begin(), order.end(), [](const glsl::GpuLight* a, const glsl::GpuLight* b) {
    return block_size(*a).y > block_size(*b).y;
  });
  glm::uvec2 corner(0);
  std::uint32_t shelf = 0;  // its height
  for (glsl::GpuLight* light : order) {
    const glm::uvec2 block = block_size(*light);
    if (block.x > width) return kMaximumAtlasSide + 1;
    if (corner.x + block.x > width) {
      corner = {0, corner.y + shelf};
      shelf = 0;
    }
    light->tile = corner;
    corner.x += block.x;
    shelf = std::max(shelf, block.y);
  }
  return corner.y + shelf;
}

// Gives every light its tiles, of at most `tile_side` texels, in the smallest atlas that holds them all.
void lay_out_atlas(LightViews& views, std::uint32_t tile_side) {
  for (std::uint32_t side = std::min(tile_side, kMaximumAtlasSide); side >= kMinimumTileSide; side /= 2) {
    for (glsl::GpuLight& light : views.lights) {
      const bool directional = light.type == glsl::kLightDirectional;
      light.tile_side = directional ? std::min(side * kDirectionalTileFactor, kMaximumAtlasSide) : side;
    }
    for (std::uint32_t width = kMinimumTileSide; width <= kMaximumAtlasSide; width *= 2) {
      const std::uint32_t height = place_on_shelves(views.lights, width);
      if (height > width) continue;
      views.atlas_width = width;
      views.atlas_height = std::max(height, 1u);
      return;
    }
  }
}

}  // namespace

std::uint32_t count_views(const glsl::GpuLight& light) {
  constexpr std::array<std::uint32_t, 4> kViews{0, 1, 6, 2};
  return kViews[light.shadow_kind];
}

LightViews make_light_views(std::span<const WorldLight> lights, const Bounds& bounds, const Bounds& focus,
                            std::uint32_t tile_side) {
  // So many blocks of the smallest tiles fit for sure, whatever their kind.
  constexpr std::uint32_t kWidestBlock = 2 * kDirectionalTileFactor * kMinimumTileSide;
  constexpr std::uint32_t kHighestBlock = kDirectionalTileFactor * kMinimumTileSide;
  constexpr std::size_t kMostLights = (kMaximumAtlasSide / kWidestBlock) * (kMaximumAtlasSide / kHighestBlock);
  static_assert(static_cast<std::uint32_t>(LightType::kPoint) == glsl::kLightPoint &&
                static_cast<std::uint32_t>(LightType::kSpot) == glsl::kLightSpot &&
                static_cast<std::uint32_t>(LightType::kDirectional) == glsl::kLightDirectional);
  const bool nested = glm::length(focus.maximum - focus.minimum) < 0.7f * glm::length(bounds.maximum - bounds.minimum);
  LightViews views;
  for (const WorldLight& light : lights) {
    glsl::GpuLight& out = views.lights.emplace_back();
    out.position = light.position;
    out.direction = light.direction;
    out.intensity = light.intensity;
    out.cos_inner = light.cos_inner;
    out.cos_outer = light.cos_outer;
    out.type = static_cast<std::uint32_t>(light.type);
    out.shadow_kind =
        tile_side > 0 && views.lights.size() <= kMostLights ? shadow_kind(light, nested) : glsl::kShadowNone;
  }
  lay_out_atlas(views, tile_side);
  const float near = near_distance(bounds);
  for (glsl::GpuLight& light : views.lights) {
    if (light.shadow_kind == glsl::kShadowNone) continue;
    if (light.type == glsl::kLightDirectional) {
      set_directional_view(light, bounds, focus);
    } else if (light.shadow_kind == glsl::kShadowCube) {
      set_cube_view(light, near);
    } else {
      set_spot_view(light, near);
    }
  }
  return views;
}

}  // namespace lightwell
