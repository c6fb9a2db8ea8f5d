// Adds one jittered frame to the film: the sums from which an anti-aliased picture and its parts are made.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/combine/combine_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D albedo;
layout(set = 0, binding = 1) uniform sampler2D emission;
layout(set = 0, binding = 2) uniform sampler2D direct;
layout(set = 0, binding = 3) uniform sampler2D indirect;
layout(set = 0, binding = 4) uniform sampler2D specular;
layout(set = 0, binding = 5) uniform sampler2D position;
layout(set = 0, binding = 6) uniform sampler2D normal;
layout(set = 0, binding = 7, rgba32f) uniform image2D film_direct;
layout(set = 0, binding = 8, rgba32f) uniform image2D film_indirect;
layout(set = 0, binding = 9, rgba32f) uniform image2D film_emission;
layout(set = 0, binding = 10, rgba32f) uniform image2D film_albedo;
layout(set = 0, binding = 11, rgba32f) uniform image2D film_normal_depth;

#include "passes/combine/combine.glsl"

// Adds to one image of the film.
#define ADD(film, value) imageStore(film, pixel, params.first_sample != 0 ? value : imageLoad(film, pixel) + value)

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(gl_GlobalInvocationID.xy, params.size))) return;
  PixelRadiance parts = pixel_radiance(pixel);
  float depth = texelFetch(position, pixel, 0).w;
  vec3 n = depth > 0.0 ? texelFetch(normal, pixel, 0).xyz : vec3(0.0);
  ADD(film_direct, vec4(parts.direct, 1.0));
  ADD(film_indirect, vec4(parts.indirect, 1.0));
  ADD(film_emission, vec4(parts.emission, 1.0));
  ADD(film_albedo, vec4(texelFetch(albedo, pixel, 0).rgb, depth > 0.0 ? 1.0 : 0.0));
  ADD(film_normal_depth, vec4(n, depth));
}
