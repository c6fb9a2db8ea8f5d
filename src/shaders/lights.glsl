// What a light sends to a point, whatever is in between. No bindings.
#ifndef LIGHTWELL_LIGHTS_GLSL
#define LIGHTWELL_LIGHTS_GLSL

#include "shaders/lights.h"

// Part of its intensity that a spot sends at an angle of this cosine to its axis: t^2,
// t = (cos - cos_outer) / (cos_inner - cos_outer) in [0,1] (glTF).
float spot_fall_off(GpuLight light, float cosine) {
  float t = clamp((cosine - light.cos_outer) / max(light.cos_inner - light.cos_outer, 1e-6), 0.0, 1.0);
  return t * t;
}

// Intensity (W/sr) of a point or spot light along the unit `direction` from it.
vec3 light_intensity(GpuLight light, vec3 direction) {
  float part = light.type == kLightSpot ? spot_fall_off(light, dot(direction, light.direction)) : 1.0;
  return light.intensity * part;
}

// Part of its light that a point or spot light still sends so far (KHR_lights_punctual): 1 - (d / range)^4, never negative.
float range_fall_off(float inverse_range, float distance_squared) {
  float square = distance_squared * inverse_range * inverse_range;
  return max(1.0 - square * square, 0.0);
}

// Irradiance perpendicular to the light's rays (W/m^2) at `position` if nothing is in between; `to_light` is unit.
// Point and spot: I / d^2, up to the light's range.
vec3 unshadowed_irradiance(GpuLight light, vec3 position, out vec3 to_light) {
  if (light.type == kLightDirectional) {
    to_light = -light.direction;
    return light.intensity;
  }
  vec3 offset = light.position - position;
  float distance_squared = max(dot(offset, offset), 1e-18);  // a light on a surface: as if 1 nm away
  to_light = offset * inversesqrt(distance_squared);
  float part = light.type == kLightSpot ? spot_fall_off(light, -dot(to_light, light.direction)) : 1.0;
  part *= range_fall_off(light.inverse_range, distance_squared);
  return light.intensity * (part / distance_squared);
}

#endif
