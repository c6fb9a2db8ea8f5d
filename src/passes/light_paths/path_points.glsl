// The light points of paths, as their kernels write them. Kernels declare, before including this file,
//   layout(set = 0, binding = n) buffer LightPointBuffer { LightPoint data[]; } points;
//   layout(set = 0, binding = n) buffer SurvivalBuffer { float data[]; } survivals;   // with which a path goes on
#ifndef LIGHTWELL_PATH_POINTS_GLSL
#define LIGHTWELL_PATH_POINTS_GLSL

#include "shaders/finite.glsl"
#include "shaders/light_point.glsl"

void store_point(uint path, vec3 position, vec3 normal, vec3 flux, float survival) {
  bool lit = is_finite(position) && is_finite(normal) && is_finite(flux) && max(max(flux.r, flux.g), flux.b) > 0.0;
  LightPoint point = LightPoint(vec3(0.0), 0, vec3(0.0), params.bounce);
  if (lit) point = LightPoint(position, pack_unit_vector(normal), flux, params.bounce);
  points.data[(params.bounce - 1) * params.path_count + path] = point;
  survivals.data[path] = lit ? survival : 0.0;
}

void store_nothing(uint path) { store_point(path, vec3(0.0), vec3(0.0), vec3(0.0), 0.0); }

#endif
