#include "passes/shadow_maps/light_views.h"

#include <algorithm>
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

std::uint32_t shadow_kind(const WorldLight& light) {
  if (light.type == LightType::kPoint) return glsl::kShadowCube;
  if (light.type == LightType::kSpot && std::acos(light.cos_outer) > kWidestSingleView) return glsl::kShadowCube;
  return glsl::kShadowSingle;
}

std::uint32_t count_views(std::uint32_t kind) {
  return kind == glsl::kShadowCube ? 6 : kind == glsl::kShadowSingle ? 1 : 0;
}

// How much wider than needed a view is, so that its guard texels lie outside of what is needed.
float guard_factor(std::uint32_t tile_side) {
  return static_cast<float>(tile_side) / static_cast<float>(tile_side - 2 * glsl::kShadowGuard);
}

// Nearest distance that a point or spot light's shadow maps see.
float near_distance(const Bounds& bounds) { return 5e-4f * std::max(glm::length(bounds.maximum - bounds.minimum), 1e-3f); }

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

// One axis across a directional view. Texel size moves in steps of 2^(1/8) and the origin in whole texels, so that
// shadows of what stands still do not crawl while the bounds change. Returns the texel's size.
float fit_axis(glsl::GpuLight& out, int row, const glm::vec3& axis, const Bounds& focus) {
  const Interval range = project(focus, axis);
  const auto inner = static_cast<float>(out.tile_side - 2 * glsl::kShadowGuard - 1);
  const float needed = std::max(range.maximum - range.minimum, 1e-4f) / inner;
  const float texel = std::exp2(std::ceil(std::log2(needed) * 8.0f) / 8.0f);
  const float center = std::round(0.5f * (range.minimum + range.maximum) / texel) * texel;
  const float half = 0.5f * texel * static_cast<float>(out.tile_side);
  set_row(out.to_shadow, row, axis, 1.0f / half, -center / half);
  return texel;
}

void set_directional_view(glsl::GpuLight& out, const Bounds& bounds, const Bounds& focus) {
  const Basis basis = make_basis(out.direction);
  out.to_shadow = glm::mat4(0.0f);
  const float texel_x = fit_axis(out, 0, basis.right, focus);
  const float texel_y = fit_axis(out, 1, basis.up, focus);
  out.texel_size = std::max(texel_x, texel_y);

  // Reversed depth: 1 where the scene begins, 0 where it ends, with room for flat scenes.
  const Interval range = project(bounds, out.direction);
  const float margin = 1e-3f * (range.maximum - range.minimum) + 1e-3f;
  const float depth = range.maximum - range.minimum + 2.0f * margin;
  set_row(out.to_shadow, 2, out.direction, -1.0f / depth, (range.maximum + margin) / depth);
  out.to_shadow[3][3] = 1.0f;
}

// Largest tile of at most `tile_side` texels with which `views` tiles fit in the atlas.
void choose_tiles(LightViews& views, std::uint32_t tile_side) {
  const std::uint32_t count = std::max(views.view_count, 1u);
  views.columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  views.rows = (count + views.columns - 1) / views.columns;
  views.tile_side = std::clamp(tile_side, kMinimumTileSide, kMaximumAtlasSide);
  while (views.tile_side > kMinimumTileSide && views.columns * views.tile_side > kMaximumAtlasSide) views.tile_side /= 2;
}

}  // namespace

LightViews make_light_views(std::span<const WorldLight> lights, const Bounds& bounds, const Bounds& focus,
                            std::uint32_t tile_side) {
  constexpr std::uint32_t kMostViews = (kMaximumAtlasSide / kMinimumTileSide) * (kMaximumAtlasSide / kMinimumTileSide);
  LightViews views;
  for (const WorldLight& light : lights) {
    glsl::GpuLight& out = views.lights.emplace_back();
    out.position = light.position;
    out.direction = light.direction;
    out.intensity = light.intensity;
    out.cos_inner = light.cos_inner;
    out.cos_outer = light.cos_outer;
    out.type = static_cast<std::uint32_t>(light.type);
    out.shadow_kind = shadow_kind(light);
    if (views.view_count + count_views(out.shadow_kind) > kMostViews) out.shadow_kind = glsl::kShadowNone;
    out.first_tile = views.view_count;
    views.view_count += count_views(out.shadow_kind);
  }
  choose_tiles(views, tile_side);
  const float near = near_distance(bounds);
  for (glsl::GpuLight& light : views.lights) {
    light.tile_side = views.tile_side;
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
