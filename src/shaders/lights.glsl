// What a light sends to a point, whatever is in between. No bindings.
#ifndef LIGHTWELL_LIGHTS_GLSL
#define LIGHTWELL_LIGHTS_GLSL

#include "shaders/lights.h"

// Irradiance perpendicular to the light's rays (W/m^2) at `position` if nothing is in between; `to_light` is unit.
// Point and spot: I / d^2. Spot fall-off: t^2, t = (cos - cos_outer) / (cos_inner - cos_outer) in [0,1] (glTF).
vec3 unshadowed_irradiance(GpuLight light, vec3 position, out vec3 to_light) {
  if (light.type == kLightDirectional) {
    to_light = -light.direction;
    return light.intensity;
  }
  vec3 offset = light.position - position;
  float distance_squared = max(dot(offset, offset), 1e-18);  // a light on a surface: as if 1 nm away
  to_light = offset * inversesqrt(distance_squared);
  float t = 1.0;
  if (light.type == kLightSpot) {
    float cosine = -dot(to_light, light.direction);
    t = clamp((cosine - light.cos_outer) / max(light.cos_inner - light.cos_outer, 1e-6), 0.0, 1.0);
  }
  return light.intensity * (t * t / distance_squared);
}

#endif
