// Divides what splats have accumulated by their weight.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/photon_splatting/paper_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
LW_PUSH_CONSTANTS(PaperNormaliseParams, LW_PAPER_NORMALISE_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D accumulated;
layout(set = 0, binding = 1) uniform sampler2D position;  // w: 0 where there is no surface
layout(set = 0, binding = 2, rgba32f) writeonly uniform image2D normalised;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.size)))) return;
  vec4 sum = texelFetch(accumulated, pixel, 0);
  vec3 irradiance = sum.w > 0.0 ? params.exposure * sum.xyz / sum.w : vec3(params.ambient);
  bool seen = texelFetch(position, pixel, 0).w > 0.0;
  imageStore(normalised, pixel, seen ? vec4(irradiance, 1.0) : vec4(0.0));
}
