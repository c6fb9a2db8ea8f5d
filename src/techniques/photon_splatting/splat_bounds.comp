// Where each splat's volume is seen: the tiles that its box covers and its range of depths.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/camera.h"
#include "techniques/photon_splatting/splat_storage.glsl"
#include "techniques/photon_splatting/splat_view_types.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(SplatBoundsParams, LW_SPLAT_BOUNDS_PARAMS)
LW_SPLATS_READ(0, 0)
layout(set = 0, binding = 1) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 2) uniform Camera { LW_GPU_CAMERA(LW_DECLARE_MEMBER) } camera;
layout(set = 0, binding = 3) writeonly buffer BoundsBuffer { SplatBounds data[]; } bounds;

#include "shaders/finite.glsl"
#include "shaders/hemisphere.glsl"
#include "shaders/linear_dispatch.glsl"

const SplatBounds kNowhere = SplatBounds(0x10001, 0, 0.0, 0.0);

struct Extent {
  vec2 low;  // pixels
  vec2 high;
};

void add_point(inout Extent extent, vec4 clip) {
  vec2 place = (clip.xy / clip.w * 0.5 + 0.5) * vec2(camera.size);
  extent.low = min(extent.low, place);
  extent.high = max(extent.high, place);
}

// Of the box before the near plane: its corners there, and where its edges meet the plane.
SplatBounds bounds_of(Splat splat) {
  mat3 frame = frame_about(splat.direction);
  vec4 center = camera.view_projection * vec4(splat.center, 1.0);
  vec4 sides[3] = vec4[3](camera.view_projection * vec4(splat.half_width * frame[0], 0.0),
                          camera.view_projection * vec4(splat.half_width * frame[1], 0.0),
                          camera.view_projection * vec4(splat.reach * frame[2], 0.0));
  float near = max(camera.znear, 1e-30);
  float spread = abs(sides[0].w) + abs(sides[1].w) + abs(sides[2].w);
  Extent extent = Extent(vec2(3e38), vec2(-3e38));
  for (uint i = 0; i < 8; ++i) {
    vec3 side = vec3(i & 1u, (i >> 1) & 1u, (i >> 2) & 1u) * 2.0 - 1.0;
    vec4 corner = center + side.x * sides[0] + side.y * sides[1] + side.z * sides[2];
    if (corner.w >= near) add_point(extent, corner);
    for (uint axis = 0; axis < 3; ++axis) {
      vec4 other = corner - 2.0 * side[axis] * sides[axis];
      if (corner.w < near && other.w >= near)
        add_point(extent, vec4(mix(corner.xyz, other.xyz, (near - corner.w) / (other.w - corner.w)), near));
    }
  }
  // A pixel's position is not exactly on the ray through its middle.
  const float kMargin = 0.1;  // pixels
  vec2 size = vec2(camera.size);
  vec2 low = extent.low - kMargin;
  vec2 high = extent.high + kMargin;
  if (center.w + spread < near || any(lessThan(high, vec2(0.0))) || any(greaterThan(low, size))) return kNowhere;
  uvec2 last = params.tiles - 1;
  uvec2 first_tile = min(uvec2(max(low, vec2(0.0))) / params.tile_pixels, last);
  uvec2 last_tile = min(uvec2(min(high, size)) / params.tile_pixels, last);
  float slack = 1e-4 * (abs(center.w) + spread);
  return SplatBounds(first_tile.x | (first_tile.y << 16), last_tile.x | (last_tile.y << 16), center.w - spread - slack,
                     center.w + spread + slack);
}

void main() {
  uint i = linear_invocation();
  uint count = min(counts.data[0], uint(bounds.data.length()));
  if (i >= count) return;
  Splat splat = splat_at(i);
  bool lights = is_finite(splat.center) && is_finite(splat.direction) && is_finite(splat.flux) &&
                is_finite(vec3(splat.half_width, splat.reach, splat.accepted)) && splat.half_width > 0.0 &&
                splat.reach > 0.0 && splat.accepted > 0.0 && any(greaterThan(splat.flux, vec3(0.0)));
  SplatBounds seen = bounds_of(splat);
  bounds.data[i] = lights ? seen : kNowhere;
}
