// Radiance towards the camera from the frame's parts. The including kernel declares sampler2D `albedo`, `emission`,
// `direct`, `indirect` (irradiance in W/m^2) and `specular` (radiance).
#ifndef LIGHTWELL_COMBINE_GLSL
#define LIGHTWELL_COMBINE_GLSL

#include "shaders/constants.glsl"

struct PixelRadiance {  // W/(sr m^2)
  vec3 direct;
  vec3 indirect;
  vec3 emission;
};

// Lambert: L = albedo / pi * E.
PixelRadiance pixel_radiance(ivec2 pixel) {
  vec3 reflectance = texelFetch(albedo, pixel, 0).rgb / kPi;
  PixelRadiance radiance;
  radiance.direct = params.has_direct != 0 ? reflectance * texelFetch(direct, pixel, 0).rgb : vec3(0.0);
  radiance.indirect = params.has_indirect != 0 ? reflectance * texelFetch(indirect, pixel, 0).rgb : vec3(0.0);
  if (params.has_specular != 0) radiance.indirect += texelFetch(specular, pixel, 0).rgb;
  radiance.emission = texelFetch(emission, pixel, 0).rgb;
  return radiance;
}

#endif
