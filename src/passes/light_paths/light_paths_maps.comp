// First surfaces of the paths of lights that have reflective shadow maps: the number pair (u, v) is warped down the
// mips of the flux' luminance (Clarberg et al. 2005), so that texels are chosen in proportion to it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_paths/light_paths_params.h"
#include "shaders/light_point.h"
#include "shaders/lights.h"
#include "shaders/shadow_view.h"

layout(local_size_x = 64) in;
layout(constant_id = 2) const bool kNoOthers = false;  // all sources have maps
layout(set = 0, binding = 0) readonly buffer LightBuffer { GpuLight data[]; } lights;
layout(set = 0, binding = 1) readonly buffer PowerBuffer { float data[]; } map_powers;
layout(set = 0, binding = 2) readonly buffer SourceBuffer { float data[]; } sources;
layout(set = 0, binding = 3) readonly buffer ShadowViewBuffer { ShadowView data[]; } views;
layout(set = 0, binding = 4) uniform sampler2D position;
layout(set = 0, binding = 5) uniform sampler2D normal;
layout(set = 0, binding = 6) uniform sampler2D flux;
layout(set = 0, binding = 7) uniform sampler2D luminances;
layout(set = 0, binding = 8) buffer LightPointBuffer { LightPoint data[]; } points;
layout(set = 0, binding = 9) buffer SurvivalBuffer { float data[]; } survivals;
layout(set = 0, binding = 10) readonly buffer SobolBuffer { uint data[]; } sobol_matrices;
layout(set = 0, binding = 11) buffer AreaBuffer { float data[]; } areas;

#include "passes/light_paths/path_points.glsl"
#include "passes/light_paths/sequence.glsl"
#include "passes/light_paths/sources.glsl"
#include "passes/rsm/rsm_view.glsl"
#include "shaders/linear_dispatch.glsl"
#include "shaders/ray_start.glsl"

// Chooses one of two in proportion to their weights, one at least positive; `u` becomes its place in the choice.
bool choose_second(float first, float second, inout float u) {
  float part = first / (first + second);
  bool is_second = second > 0.0 && u >= part;
  u = is_second ? (u - part) / (1.0 - part) : u / part;
  u = clamp(u, 0.0, 0.99999994);
  return is_second;
}

float luminance_at(ivec2 texel, uint level) { return texelFetch(luminances, texel, int(level)).r; }

// The tile of a light and, from the coarsest mip to the finest, the texel in it; first the row, then the column.
ivec2 choose_texel(ShadowView view, out uint face, inout vec2 u) {
  uint level = params.top_level;
  ivec2 texel = ivec2(view.tile >> level);
  face = 0;
  if (view.kind == kShadowCube) {
    vec3 upper, lower;
    for (int i = 0; i < 3; ++i) {
      upper[i] = luminance_at(texel + ivec2(i, 0), level);
      lower[i] = luminance_at(texel + ivec2(i, 1), level);
    }
    bool second_row = choose_second(upper.x + upper.y + upper.z, lower.x + lower.y + lower.z, u.y);
    vec3 row = second_row ? lower : upper;
    uint column = 0;
    if (choose_second(row.x, row.y + row.z, u.x)) column = choose_second(row.y, row.z, u.x) ? 2 : 1;
    face = (second_row ? 3 : 0) + column;
    texel += ivec2(face % 3, face / 3);
  }
  for (; level > 0; --level) {
    texel *= 2;
    float upper_left = luminance_at(texel, level - 1);
    float upper_right = luminance_at(texel + ivec2(1, 0), level - 1);
    float lower_left = luminance_at(texel + ivec2(0, 1), level - 1);
    float lower_right = luminance_at(texel + ivec2(1, 1), level - 1);
    bool second_row = choose_second(upper_left + upper_right, lower_left + lower_right, u.y);
    bool second_column =
        choose_second(second_row ? lower_left : upper_left, second_row ? lower_right : upper_right, u.x);
    texel += ivec2(second_column ? 1 : 0, second_row ? 1 : 0);
  }
  return texel;
}

// Whether the plane through `place` goes on at a texel of the same tile.
bool goes_on(ShadowView view, uint face, ivec2 texel, vec3 place, vec3 n) {
  ivec2 inside = texel - ivec2(tile_corner(view, face));
  if (any(lessThan(inside, ivec2(0))) || any(greaterThanEqual(inside, ivec2(view.tile_side)))) return false;
  const float kFlat = 0.01;
  vec4 other = texelFetch(position, texel, 0);
  vec3 offset = other.xyz - place;
  return other.w > 0.0 && abs(dot(offset, n)) < kFlat * length(offset);
}

// Along a perspective view, m; 1 in a directional light's.
float depth_in_view(ShadowView view, GpuLight light, uint face, vec3 place) {
  if (view.kind == kShadowOrthographic) return 1.0;
  vec3 forward = view.kind == kShadowCube ? from_cube_face(face, vec3(0.0, 0.0, 1.0)) : view_row(view, 3);
  return dot(place - light.position, forward);
}

// The texel's surface at u in [0,1)^2 of it rather than at its centre, along each axis where the surface goes on.
vec3 place_in_texel(ShadowView view, GpuLight light, uint face, ivec2 texel, vec2 u, vec3 place, vec3 n) {
  vec2 shift = u - 0.5;
  if (!goes_on(view, face, texel + ivec2(shift.x < 0.0 ? -1 : 1, 0), place, n)) shift.x = 0.0;
  if (!goes_on(view, face, texel + ivec2(0, shift.y < 0.0 ? -1 : 1), place, n)) shift.y = 0.0;
  vec2 ndc = (vec2(texel - ivec2(tile_corner(view, face))) + 0.5) * (2.0 / float(view.tile_side)) - 1.0;
  vec2 step_ndc = shift * (2.0 / float(view.tile_side));
  // Along the view's ray through the shifted point, back to the surface's plane.
  vec3 direction = view_direction(view, light, face, ndc + step_ndc);
  vec3 across = across_view(view, face, step_ndc) * depth_in_view(view, light, face, place);
  float slope = dot(direction, n);
  if (abs(slope) < 1e-3 * length(direction)) return place;
  return place + across - direction * (dot(across, n) / slope);
}

void main() {
  uint path = linear_invocation();
  if (path >= params.path_count) return;
  uint index = params.first_path + path;
  SourceChoice choice = choose_source(source_number(index));
  uint source = min(choice.source, params.light_count - 1);
  bool from_map = source == choice.source && map_powers.data[source] > 0.0;
  if (!from_map) {
    if (kNoOthers) store_nothing(path);
    return;
  }
  GpuLight light = lights.data[source];
  ShadowView view = views.data[source];
  vec2 u = start_numbers(index, choice.place);
  uint face;
  ivec2 texel = choose_texel(view, face, u);
  vec4 reflected = texelFetch(flux, texel, 0);
  vec3 n = texelFetch(normal, texel, 0).xyz;
  vec3 place = place_in_texel(view, light, face, texel, u, texelFetch(position, texel, 0).xyz, n);
  float probability = luminance_at(texel, 0) / map_powers.data[source] * choice.probability;
  vec3 arriving = place - light.position;
  if (view.kind == kShadowOrthographic) arriving = light.direction;
  arriving = normalize(arriving);
  // Of the texel, across the light: its area in the view's plane at that depth, by the cosine to the view's axis.
  vec2 texel_size = 2.0 * view_half_size(view) / float(view.tile_side);
  float depth = depth_in_view(view, light, face, place);
  float slant = view.kind == kShadowOrthographic ? 1.0 : depth / max(distance(place, light.position), 1e-30);
  float area = texel_size.x * texel_size.y * depth * depth * slant;
  float paths = probability * float(params.path_count);
  store_point(path, ray_start(place, n), n, reflected.rgb / paths, reflected.a, area / paths, -dot(n, arriving));
}
