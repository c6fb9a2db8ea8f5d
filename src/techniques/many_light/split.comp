// Splits position and normal into 4 x 4 tiles (Sun and Agu 2015, Eq. 4.1 to 4.3): pixel `c` of the split image shows
// pixel (c mod tile size) * 4 + c / tile size of the picture. Where the picture has none, there is no surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/many_light/many_light_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
LW_PUSH_CONSTANTS(SplitParams, LW_SPLIT_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D face;
layout(set = 0, binding = 3, rgba32f) writeonly uniform image2D split_position;
layout(set = 0, binding = 4, rgba16f) writeonly uniform image2D split_normal;
layout(set = 0, binding = 5, rgba16f) writeonly uniform image2D split_face;

void main() {
  uvec2 place = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(place, kSplit * params.tile_size))) return;
  ivec2 pixel = ivec2((place % params.tile_size) * kSplit + place / params.tile_size);
  bool inside = all(lessThan(pixel, ivec2(params.size)));
  pixel = min(pixel, ivec2(params.size) - 1);
  imageStore(split_position, ivec2(place), inside ? texelFetch(position, pixel, 0) : vec4(0.0));
  imageStore(split_normal, ivec2(place), texelFetch(normal, pixel, 0));
  imageStore(split_face, ivec2(place), texelFetch(face, pixel, 0));
}
