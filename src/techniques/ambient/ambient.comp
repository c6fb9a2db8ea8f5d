#version 450
#include "techniques/ambient/ambient.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D position;  // w: distance along the view, 0 where nothing is seen
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D irradiance;

// The same irradiance on every surface.
void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  const bool seen = texelFetch(position, ivec2(pixel), 0).w > 0.0;
  imageStore(irradiance, ivec2(pixel), vec4(vec3(seen ? params.irradiance : 0.0), 1.0));
}
