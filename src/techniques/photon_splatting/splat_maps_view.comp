// The shadow maps of the first splats: each a square of the picture, its texels the brighter the farther the surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/photon_splatting/splat_storage.glsl"
#include "techniques/photon_splatting/splat_view_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
LW_PUSH_CONSTANTS(SplatMapsParams, LW_SPLAT_MAPS_PARAMS)
LW_SPLATS_READ(0, 0)
layout(set = 0, binding = 1) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 2) uniform sampler2D shadow_atlas;
layout(set = 0, binding = 3, rgba32f) writeonly uniform image2D picture;

#include "techniques/photon_splatting/shadow_atlas.glsl"

void main() {
  const uint kShownSide = 32;  // pixels of a map, and one between them
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  uint across = max(1, params.size.x / (kShownSide + 1));
  uvec2 place = pixel / (kShownSide + 1);
  uvec2 inside = pixel % (kShownSide + 1);
  uint index = place.y * across + place.x;
  bool is_map = place.x < across && index < counts.data[0] && all(lessThan(inside, uvec2(kShownSide)));
  Splat splat = splat_at(index);
  ivec2 texel = map_corner(splat.map, params.maps_per_row, params.map_side) +
                ivec2(inside * params.map_side / kShownSide);
  float depth = texelFetch(shadow_atlas, texel, 0).x / max(2.0 * splat.reach, 1e-30);
  imageStore(picture, ivec2(pixel), is_map ? vec4(vec3(clamp(depth, 0.0, 1.0)), 1.0) : vec4(0.0));
}
