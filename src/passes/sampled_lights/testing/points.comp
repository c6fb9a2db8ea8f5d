// Point i of every pixel, at i * pixels + pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sampled_lights/testing/points.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) writeonly buffer PointBuffer { vec2 data[]; } points;

#include "shaders/random.glsl"

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  for (uint i = 0; i < params.count; ++i)
    points.data[(i * params.size.y + pixel.y) * params.size.x + pixel.x] = stratified_point(pixel, i, params.set);
}
