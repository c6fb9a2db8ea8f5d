// The picture: all of a pixel's light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/combine/combine_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D albedo;
layout(set = 0, binding = 1) uniform sampler2D emission;
layout(set = 0, binding = 2) uniform sampler2D direct;
layout(set = 0, binding = 3) uniform sampler2D indirect;
layout(set = 0, binding = 4) uniform sampler2D specular;
layout(set = 0, binding = 5, rgba32f) writeonly uniform image2D radiance;

#include "passes/combine/combine.glsl"

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  PixelRadiance parts = pixel_radiance(ivec2(pixel));
  imageStore(radiance, ivec2(pixel), vec4(parts.direct + parts.indirect + parts.emission, 1.0));
}
