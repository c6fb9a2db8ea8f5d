// Radiance to display values, as tone_map() of lightwell/metrics.h: sRGB(x / (1 + x)), x = exposure * max(radiance, 0).
// A draw and not a dispatch: every format that a window can show can be drawn to, few can be stored to.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/tonemap/tonemap_params.h"

layout(set = 0, binding = 0) uniform sampler2D radiance;
layout(location = 0) out vec4 color;

vec3 srgb_encode(vec3 linear) {
  return mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

void main() {
  vec3 x = params.exposure * max(texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb, vec3(0.0));
  vec3 display = x / (1.0 + x);
  color = vec4(params.encode_srgb != 0 ? srgb_encode(display) : display, 1.0);
}
