// Light that comes straight from the lights, at any world position. The including kernel declares, by these names,
//   layout(set = 0, binding = n) readonly buffer LightBuffer { GpuLight data[]; } lights;
//   layout(set = 0, binding = n) readonly buffer ShadowViewBuffer { ShadowView data[]; } shadow_views;
//   layout(set = 0, binding = n) uniform sampler2D shadow_atlas;
// before including this file (shaders/lights.h and shaders/shadow_view.h come first). read_lights() binds them.
#ifndef LIGHTWELL_DIRECT_GLSL
#define LIGHTWELL_DIRECT_GLSL

#include "shaders/lights.glsl"
#include "shaders/shadow.glsl"

// The finest of a light's views that shows what is about a position.
uint shadow_view_at(uint light, vec3 position) {
  uint view = light;
  for (uint i = 0; i < kMostShadowViews && shadow_views.data[view].wider != 0; ++i) {
    if (is_within(shadow_views.data[view], position)) break;
    view = shadow_views.data[view].wider;
  }
  return view;
}

// Irradiance E (W/m^2, before albedo) from light `index` on the side of the unit `normal`, shadows included.
vec3 light_irradiance(uint index, vec3 position, vec3 normal) {
  vec3 to_light;
  vec3 perpendicular = unshadowed_irradiance(lights.data[index], position, to_light);
  float cosine = dot(normal, to_light);
  if (cosine <= 0.0 || perpendicular == vec3(0.0)) return vec3(0.0);
  uint view = shadow_view_at(index, position);
  return perpendicular * (cosine * shadow_visibility(shadow_views.data[view], position, normal));
}

// The sum over the first `light_count` lights.
vec3 direct_irradiance(vec3 position, vec3 normal, uint light_count) {
  vec3 sum = vec3(0.0);
  for (uint i = 0; i < light_count; ++i) sum += light_irradiance(i, position, normal);
  return sum;
}

#endif
