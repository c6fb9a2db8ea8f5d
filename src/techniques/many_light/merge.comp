// Puts the split light together again: the inverse of split.comp (Sun and Agu 2015, Eq. 4.4 to 4.6).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/many_light/many_light_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
LW_PUSH_CONSTANTS(SplitParams, LW_SPLIT_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D split_light;
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D merged;

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  uvec2 place = (pixel % kSplit) * params.tile_size + pixel / kSplit;
  imageStore(merged, ivec2(pixel), texelFetch(split_light, ivec2(place), 0));
}
