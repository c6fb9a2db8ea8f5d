// What a light point sends to a surface.
#ifndef LIGHTWELL_LIGHT_POINT_GLSL
#define LIGHTWELL_LIGHT_POINT_GLSL

#include "shaders/constants.glsl"
#include "shaders/light_point.h"
#include "shaders/octahedral.glsl"

uint pack_unit_vector(vec3 v) { return packSnorm2x16(to_octahedron(v)); }
vec3 unpack_unit_vector(uint packed) { return from_octahedron(unpackSnorm2x16(packed)); }

// cos cos' / max(least, d^2) between a surface with the unit `normal` and a light point.
float clamped_geometry(vec3 position, vec3 normal, LightPoint point, float least) {
  vec3 offset = point.position - position;
  float squared = dot(offset, offset);
  vec3 direction = offset * inversesqrt(max(squared, 1e-37));
  float cosine = max(0.0, dot(normal, direction));
  float cosine_there = max(0.0, -dot(unpack_unit_vector(point.normal), direction));
  return cosine * cosine_there / max(max(least, squared), 1e-20);
}

// Irradiance W/m^2 of flux Phi that leaves a point cosine-distributed: E = Phi G / pi.
vec3 light_point_irradiance(LightPoint point, float geometry) { return point.flux * (geometry / kPi); }

#endif
