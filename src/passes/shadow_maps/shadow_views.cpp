#include "passes/shadow_maps/shadow_views.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lightwell {
namespace {

// Room for views of the whole scene as large as without balls, in those of balls: three quarters of the largest atlas.
constexpr std::size_t kMostHalfViews = 12;
constexpr float kWidestSpotView = 1.0471976f;  // radians from the axis: wider spots get a cube

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

glm::vec3 middle(const Bounds& bounds) {
  return 0.5f * (bounds.minimum + bounds.maximum);
}

// Whether the light is farther away than the scene is long, and its cone not narrower than that in which it sees the
// scene, of at most 30 degrees from the axis.
bool sees_scene_from_afar(const WorldLight& light, const Bounds& bounds) {
  const float size = scene_size(bounds);
  const float distance = glm::distance(light.position, middle(bounds));
  if (!(distance > size) || !std::isfinite(distance)) return false;
  const float sine = 0.5f * size / distance;
  return light.type == LightType::kPoint || light.cos_outer < std::sqrt(1.0f - sine * sine);
}

// Rounded up to the next of eight steps an octave.
float round_up(float value) {
  return std::exp2(std::ceil(std::log2(value) * 8.0f) / 8.0f);
}

// How much wider than needed a view is, so that its guard texels lie outside of what is needed.
float guard_factor(std::uint32_t tile_side, std::uint32_t guard) {
  return static_cast<float>(tile_side) / static_cast<float>(tile_side - 2 * guard);
}

// Nearest distance that a point or spot light's shadow maps see. Reversed depth is as precise whatever it is; a lamp on
// a kilometre of ground must not look through its room's walls.
float near_distance(const Bounds& bounds) {
  return 5e-4f * std::min(scene_size(bounds), kSmallScene);
}

void set_cube_view(float near, std::uint32_t guard, glsl::ShadowView& out) {
  const float half = guard_factor(out.tile_side, guard);  // tangent of 45 degrees is 1
  out.to_shadow = glm::mat4(0.0f);
  out.to_shadow[0][0] = 1.0f / half;
  out.to_shadow[1][1] = 1.0f / half;
  out.to_shadow[2][3] = 1.0f;
  out.to_shadow[3][2] = near;
  out.texel_size = 2.0f * half / static_cast<float>(out.tile_side);
}

void set_spot_view(const WorldLight& light, float near, std::uint32_t guard, glsl::ShadowView& out) {
  const float half = std::tan(std::max(std::acos(light.cos_outer), 0.01f)) * guard_factor(out.tile_side, guard);
  const Basis basis = make_basis(light.direction);
  out.to_shadow = glm::mat4(0.0f);
  set_row(out.to_shadow, 0, basis.right, 1.0f / half, -glm::dot(basis.right, light.position) / half);
  set_row(out.to_shadow, 1, basis.up, 1.0f / half, -glm::dot(basis.up, light.position) / half);
  set_row(out.to_shadow, 3, light.direction, 1.0f, -glm::dot(light.direction, light.position));
  out.to_shadow[3][2] = near;
  out.texel_size = 2.0f * half / static_cast<float>(out.tile_side);
}

struct Interval {
  float minimum = INFINITY;
  float maximum = -INFINITY;
};

glm::vec3 corner(const Bounds& bounds, int index) {
  return {(index & 1) != 0 ? bounds.maximum.x : bounds.minimum.x,
          (index & 2) != 0 ? bounds.maximum.y : bounds.minimum.y,
          (index & 4) != 0 ? bounds.maximum.z : bounds.minimum.z};
}

Interval project(const Bounds& bounds, const glm::vec3& axis) {
  Interval interval;
  for (int i = 0; i < 8; ++i) {
    interval.minimum = std::min(interval.minimum, glm::dot(axis, corner(bounds, i)));
    interval.maximum = std::max(interval.maximum, glm::dot(axis, corner(bounds, i)));
  }
  return interval;
}

// Depths along a view that hold a range of them, with room for flat scenes.
Interval with_margin(const Interval& range, const Bounds& bounds) {
  const float margin = 1e-3f * (range.maximum - range.minimum) + 1e-4f * scene_size(bounds);
  return {range.minimum - margin, range.maximum + margin};
}

// How large a view of the whole scene or of one ball is.
struct Extent {
  const Bounds& bounds;
  const FocusBall* ball = nullptr;
};

// The whole scene, or a ball of it, from afar. All is relative to a point in the scene, so that precision does not
// suffer from the distance; that point moves in steps, as the width does, so that static shadows do not crawl while the
// bounds change.
void set_fitted_view(const WorldLight& light, const Extent& extent, std::uint32_t guard, glsl::ShadowView& out) {
  const Bounds& bounds = extent.bounds;
  const float step = std::exp2(std::round(std::log2(scene_size(bounds)))) / 16.0f;
  const glm::vec3 target = glm::round(middle(bounds) / step) * step;
  const float distance = glm::distance(target, light.position);
  const glm::vec3 forward = (target - light.position) / distance;
  const Basis basis = make_basis(forward);
  Interval depth;                                         // from the target
  glm::vec2 half(1e-5f * scene_size(bounds) / distance);  // tangents
  for (int i = 0; i < 8; ++i) {
    const glm::vec3 offset = corner(bounds, i) - target;
    const float along = glm::dot(forward, offset);
    depth = {std::min(depth.minimum, along), std::max(depth.maximum, along)};
    const glm::vec2 across(glm::dot(basis.right, offset), glm::dot(basis.up, offset));
    half = glm::max(half, glm::abs(across) / (distance + along));
  }
  glm::vec2 center(0.0f);  // tangents
  if (extent.ball) {
    // In whole texels, as fit_axis() has it.
    const glm::vec3 offset = extent.ball->center - target;
    const float along = distance + glm::dot(forward, offset);
    const auto inner = static_cast<float>(out.tile_side - std::max(4 * guard, 1u));
    const float texel =
        round_up(2.0f * extent.ball->radius / std::max(along - extent.ball->radius, 0.25f * along) / inner);
    const glm::vec2 across(glm::dot(basis.right, offset), glm::dot(basis.up, offset));
    center = glm::round(across / along / texel) * texel;
    half = glm::vec2(0.5f * texel * static_cast<float>(out.tile_side));
  } else {
    half = guard_factor(out.tile_side, guard) * glm::vec2(round_up(half.x), round_up(half.y));
  }
  out.to_shadow = glm::mat4(0.0f);
  set_row(out.to_shadow, 3, forward, 1.0f, distance - glm::dot(forward, target));
  set_row(out.to_shadow, 0, basis.right - center.x * forward, 1.0f / half.x,
          -(glm::dot(basis.right - center.x * forward, target) + center.x * distance) / half.x);
  set_row(out.to_shadow, 1, basis.up - center.y * forward, 1.0f / half.y,
          -(glm::dot(basis.up - center.y * forward, target) + center.y * distance) / half.y);
  out.texel_size = 2.0f * std::max(half.x, half.y) / static_cast<float>(out.tile_side);

  // Reversed depth: near * (far - w) / (far - near) / w is 1 where the scene begins, 0 where it ends.
  depth = with_margin(depth, bounds);
  const float scale = (distance + depth.minimum) / (depth.maximum - depth.minimum);
  set_row(out.to_shadow, 2, forward, -scale, scale * (depth.maximum + glm::dot(forward, target)));
}

// One axis across a directional view: from metres along it to NDC.
struct Fit {
  float scale;
  float offset;
};

// One axis across a directional view. Texel size moves in steps of 2^(1/8) and the origin in whole texels, so that
// static shadows do not crawl while the bounds change; that takes half a texel on each side.
Fit fit_axis(const glm::vec3& axis, const Extent& extent, std::uint32_t tile_side, std::uint32_t guard) {
  Interval range;
  if (extent.ball) {
    const float center = glm::dot(axis, extent.ball->center);
    range = {center - extent.ball->radius, center + extent.ball->radius};
  } else {
    range = project(extent.bounds, axis);
  }
  const auto inner = static_cast<float>(tile_side - std::max(4 * guard, 1u));
  // Of a ball it is 2 r exactly, wherever the centre is rounded to.
  const float wide = extent.ball ? 2.0f * extent.ball->radius : range.maximum - range.minimum;
  const float needed = std::max(wide, 1e-5f * scene_size(extent.bounds)) / inner;
  const float texel = round_up(needed);
  const float center = std::round(0.5f * (range.minimum + range.maximum) / texel) * texel;
  const float half = 0.5f * texel * static_cast<float>(tile_side);
  return {1.0f / half, -center / half};
}

void set_directional_view(const WorldLight& light, const Extent& extent, std::uint32_t guard, glsl::ShadowView& out) {
  const Basis basis = make_basis(light.direction);
  out.to_shadow = glm::mat4(0.0f);
  const Fit x = fit_axis(basis.right, extent, out.tile_side, guard);
  const Fit y = fit_axis(basis.up, extent, out.tile_side, guard);
  set_row(out.to_shadow, 0, basis.right, x.scale, x.offset);
  set_row(out.to_shadow, 1, basis.up, y.scale, y.offset);
  out.texel_size = 2.0f / (std::min(x.scale, y.scale) * static_cast<float>(out.tile_side));

  // Reversed depth: 1 where the scene begins, 0 where it ends.
  const Interval range = with_margin(project(extent.bounds, light.direction), extent.bounds);
  const float depth = range.maximum - range.minimum;
  set_row(out.to_shadow, 2, light.direction, -1.0f / depth, range.maximum / depth);
  out.to_shadow[3][3] = 1.0f;
}

// A light's kind of view, and the texels that it would like.
void choose_view(const WorldLight& light, const Bounds& bounds, std::uint32_t tile_side,
                 std::uint32_t whole_scene_factor, glsl::ShadowView& out) {
  out.tile_side = tile_side;
  if (light.type == LightType::kDirectional) {
    out.kind = glsl::kShadowOrthographic;
    out.tile_side *= whole_scene_factor;
  } else if (sees_scene_from_afar(light, bounds)) {
    out.kind = glsl::kShadowPerspective;
    out.tile_side *= whole_scene_factor;
  } else {
    const bool narrow = light.type == LightType::kSpot && std::acos(light.cos_outer) <= kWidestSpotView;
    out.kind = narrow ? glsl::kShadowPerspective : glsl::kShadowCube;
  }
}

// Whether one view of the light holds the whole scene.
bool sees_all(const WorldLight& light, const Bounds& bounds) {
  return light.type == LightType::kDirectional || sees_scene_from_afar(light, bounds);
}

void set_view(const WorldLight& light, const Extent& extent, std::uint32_t guard, glsl::ShadowView& out) {
  const Bounds& bounds = extent.bounds;
  if (out.kind == glsl::kShadowNone) return;
  if (light.type == LightType::kDirectional) return set_directional_view(light, extent, guard, out);
  if (sees_scene_from_afar(light, bounds)) return set_fitted_view(light, extent, guard, out);
  if (out.kind == glsl::kShadowCube) return set_cube_view(near_distance(bounds), guard, out);
  set_spot_view(light, near_distance(bounds), guard, out);
}

// Rows are those of to_cube_face() in shaders/shadow_view.glsl.
glm::mat4 face_from_world(std::uint32_t face, const glm::vec3& position) {
  const int axis = static_cast<int>(face / 2);
  glm::mat4 matrix(0.0f);
  for (int row = 0; row < 3; ++row) {
    const int column = (axis + 1 + row) % 3;
    const float sign = row == 2 && face % 2 == 1 ? -1.0f : 1.0f;
    matrix[column][row] = sign;
    matrix[3][row] = -sign * position[column];
  }
  matrix[3][3] = 1.0f;
  return matrix;
}

}  // namespace

ShadowViews make_shadow_views(std::span<const WorldLight> lights, const Bounds& bounds,
                              std::span<const FocusBall> balls, std::uint32_t tile_side, std::uint32_t atlas_side,
                              const ViewFit& fit) {
  ShadowViews result;
  std::vector<std::uint32_t> nested;  // lights with a view of each ball
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    glsl::ShadowView& view = result.views.emplace_back();
    view.position = lights[i].position;
    choose_view(lights[i], bounds, tile_side, fit.whole_scene_factor, view);
    if (!balls.empty() && sees_all(lights[i], bounds)) nested.push_back(i);
  }
  // The light's own element is the finest view, the last one behind the lights' is that of the whole scene. Few of
  // these may be as large as without balls.
  const bool wide_is_smaller = nested.size() * (balls.size() + 4) > kMostHalfViews;
  for (const std::uint32_t light : nested) {
    const std::uint32_t side = result.views[light].tile_side;
    std::uint32_t finer = light;
    result.views[light].tile_side = side / 2;
    for (std::size_t k = 1; k <= balls.size(); ++k) {
      glsl::ShadowView wider = result.views[light];
      wider.wider = 0;
      wider.tile_side = k < balls.size() || wide_is_smaller ? side / 2 : side;
      result.views[finer].wider = static_cast<std::uint32_t>(result.views.size());
      finer = result.views[finer].wider;
      result.views.push_back(wider);
    }
  }
  result.atlas = lay_out_atlas(result.views, atlas_side);
  for (std::size_t i = 0; i < lights.size(); ++i)
    set_view(lights[i], {bounds, result.views[i].wider != 0 ? &balls.front() : nullptr}, fit.guard, result.views[i]);
  for (const std::uint32_t light : nested) {
    std::uint32_t view = result.views[light].wider;
    for (std::size_t k = 1; k <= balls.size(); ++k, view = result.views[view].wider)
      set_view(lights[light], {bounds, k < balls.size() ? &balls[k] : nullptr}, fit.guard, result.views[view]);
  }
  return result;
}

glm::mat4 clip_from_world(const glsl::ShadowView& view, std::uint32_t face) {
  return view.kind == glsl::kShadowCube ? view.to_shadow * face_from_world(face, view.position) : view.to_shadow;
}

}  // namespace lightwell
