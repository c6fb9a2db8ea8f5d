// Light that comes straight from the lights, at any world position. The including kernel declares, by these names,
//   layout(set = 0, binding = n) readonly buffer LightBuffer { GpuLight data[]; } lights;   // FrameInputs::lights
//   layout(set = 0, binding = n) uniform sampler2D shadow_atlas;                            // FrameInputs::shadow_atlas
// before including this file (shaders/lights.h comes first). Bind shadow_atlas with SamplerKind::kNearestClamp.
#ifndef LIGHTWELL_DIRECT_GLSL
#define LIGHTWELL_DIRECT_GLSL

#include "shaders/lights.glsl"
#include "shaders/shadow.glsl"

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
