// Irradiance at every pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/light_volume/surfel_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) readonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 3) readonly buffer LitBuffer { LitSurfel data[]; } lit;
layout(set = 0, binding = 4) uniform sampler2D environment;
layout(set = 0, binding = 5, rgba32f) writeonly uniform image2D irradiance;

#include "techniques/light_volume/surfel_lookup.glsl"

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 p = texelFetch(position, ivec2(pixel), 0);
  vec3 e = vec3(0.0);
  if (p.w > 0.0) e = look_up(p.xyz, normalize(texelFetch(normal, ivec2(pixel), 0).xyz));
  imageStore(irradiance, ivec2(pixel), vec4(e, 1.0));
}
