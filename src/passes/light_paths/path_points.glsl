// The light points of paths, as their kernels write them. Kernels declare, before including this file,
//   layout(set = 0, binding = n) buffer LightPointBuffer { LightPoint data[]; } points;
//   layout(set = 0, binding = n) buffer SurvivalBuffer { float data[]; } survivals;   // with which a path goes on
//   layout(set = 0, binding = n) buffer AreaBuffer { float data[]; } areas;   // m^2 that the path stands for, a point
#ifndef LIGHTWELL_PATH_POINTS_GLSL
#define LIGHTWELL_PATH_POINTS_GLSL

#include "shaders/finite.glsl"
#include "shaders/light_point.glsl"

layout(constant_id = 5) const bool kAreas = false;  // the caller wants them

// `area`: m^2 across the arriving light, which meets the surface under `cosine`.
void store_point(uint path, vec3 position, vec3 normal, vec3 flux, float survival, float area, float cosine) {
  bool lit = is_finite(position) && is_finite(normal) && is_finite(flux) && max(max(flux.r, flux.g), flux.b) > 0.0;
  LightPoint point = LightPoint(vec3(0.0), 0, vec3(0.0), params.bounce);
  if (lit) point = LightPoint(position, pack_unit_vector(normal), flux, params.bounce);
  uint element = (params.bounce - 1) * params.path_count + path;
  points.data[element] = point;
  survivals.data[path] = lit ? survival : 0.0;
  const float kLeastCosine = 0.05;
  if (kAreas) areas.data[element] = lit ? area / max(cosine, kLeastCosine) : 0.0;
}

void store_nothing(uint path) { store_point(path, vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, 1.0); }

#endif
