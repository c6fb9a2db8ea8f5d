// Light that comes straight from the lights, at any world position. The including kernel declares, by these names,
//   layout(set = 0, binding = n) readonly buffer LightBuffer { GpuLight data[]; } lights;   // FrameInputs::lights
//   layout(set = 0, binding = n) uniform sampler2D shadow_atlas;                            // FrameInputs::shadow_atlas
// before including this file (shaders/lights.h comes first). Bind shadow_atlas with SamplerKind::kNearestClamp.
#ifndef LIGHTWELL_DIRECT_GLSL
#define LIGHTWELL_DIRECT_GLSL

#include "shaders/lights.h"
#include "shaders/shadow.glsl"

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

// Irradiance E (W/m^2, before albedo) from one light on the side of the unit `normal`, shadows included.
vec3 light_irradiance(GpuLight light, vec3 position, vec3 normal) {
  vec3 to_light;
  vec3 perpendicular = unshadowed_irradiance(light, position, to_light);
  float cosine = dot(normal, to_light);
  if (cosine <= 0.0 || perpendicular == vec3(0.0)) return vec3(0.0);
  return perpendicular * (cosine * shadow_visibility(light, position, normal));
}

// The sum over the first `light_count` lights.
vec3 direct_irradiance(vec3 position, vec3 normal, uint light_count) {
  vec3 sum = vec3(0.0);
  for (uint i = 0; i < light_count; ++i) sum += light_irradiance(lights.data[i], position, normal);
  return sum;
}

#endif
