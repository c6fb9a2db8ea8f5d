// Light from outside. The including kernel declares, before including this file,
//   layout(set = 0, binding = n) uniform sampler2D environment;   // WorldFrame::environment, kNearestClamp
#ifndef LIGHTWELL_ENVIRONMENT_GLSL
#define LIGHTWELL_ENVIRONMENT_GLSL

#include "shaders/constants.glsl"

// Radiance W/(sr m^2) from the unit `direction` (pointing outwards). Latitude-longitude: u = atan2(x, -z) / 2pi + 1/2,
// v = acos(y) / pi. Interpolated here, since linear filtering of 32-bit floats is not on every device.
vec3 environment_radiance(vec3 direction) {
  ivec2 size = textureSize(environment, 0);
  if (size == ivec2(1)) return texelFetch(environment, ivec2(0), 0).rgb;
  vec2 uv = vec2(atan(direction.x, -direction.z) / (2.0 * kPi) + 0.5, acos(clamp(direction.y, -1.0, 1.0)) / kPi);
  vec2 texel = uv * vec2(size) - 0.5;
  ivec2 base = ivec2(floor(texel));
  vec2 f = texel - vec2(base);
  int x0 = (base.x + size.x) % size.x;
  int x1 = (base.x + 1) % size.x;
  int y0 = clamp(base.y, 0, size.y - 1);
  int y1 = clamp(base.y + 1, 0, size.y - 1);
  vec3 top = mix(texelFetch(environment, ivec2(x0, y0), 0).rgb, texelFetch(environment, ivec2(x1, y0), 0).rgb, f.x);
  vec3 bottom = mix(texelFetch(environment, ivec2(x0, y1), 0).rgb, texelFetch(environment, ivec2(x1, y1), 0).rgb, f.x);
  return mix(top, bottom, f.y);
}

#endif
