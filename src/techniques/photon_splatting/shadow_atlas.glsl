// Where a splat's shadow map lies in the atlas of all maps, and the frame in which maps and kernels are measured.
#ifndef LIGHTWELL_PHOTON_SPLATTING_SHADOW_ATLAS_GLSL
#define LIGHTWELL_PHOTON_SPLATTING_SHADOW_ATLAS_GLSL

#include "shaders/hemisphere.glsl"
#include "techniques/photon_splatting/splat_types.h"

// Where `position` is in the splat's box: xy across the ray, -1 to 1 from edge to edge of kernel and map; z along it, m
// from the plane at -reach, as maps hold it: 0 to 2 reach.
vec3 place_in_splat(Splat splat, vec3 position) {
  vec3 offset = (position - splat.center) * frame_about(splat.direction);  // the transposed frame's product
  return vec3(offset.xy / splat.half_width, offset.z + splat.reach);
}

// Its inverse for points of the plane through the center.
vec3 across_splat(Splat splat, vec2 place) {
  mat3 frame = frame_about(splat.direction);
  return splat.center + splat.half_width * (place.x * frame[0] + place.y * frame[1]);
}

// The texel of a map that holds a place, and the place of a texel's middle; `side`: texels of a map.
ivec2 map_texel(vec2 place, uint side) {
  return clamp(ivec2(floor((0.5 * place + 0.5) * float(side))), ivec2(0), ivec2(int(side) - 1));
}
vec2 texel_place(ivec2 texel, uint side) { return (2.0 * vec2(texel) + 1.0) / float(side) - 1.0; }

// Of the atlas, that is texel (0, 0) of map number `map`.
ivec2 map_corner(uint map, uint maps_per_row, uint side) {
  return ivec2(map % maps_per_row, map / maps_per_row) * int(side);
}

#endif
