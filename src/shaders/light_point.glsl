// Light that arrives at a surface and leaves it again.
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

// What arrives along the unit `direction` is gathered by the shading normal's cosine and was counted by the face's: a
// surface turns that into radiosity with the first, and rays find it in proportion to the second (Veach 1997, Sec.
// 5.3). Both normals unit, on the side that is hit. 1 on flat surfaces. Bounded: the bound takes less than 0.3 % of the
// light where the normals differ by 10 degrees.
float shading_gain(vec3 normal, vec3 face_normal, vec3 direction) {
  const float kMostGain = 8.0;
  float cosine = max(-dot(face_normal, direction), 1e-6);
  return clamp(-dot(normal, direction) / cosine, 0.0, kMostGain);
}

// Probability with which a path goes on from a surface: flux over it never grows, and it is 0 for black surfaces only.
float survival_of(vec3 albedo) { return clamp(max(max(albedo.r, albedo.g), albedo.b), 0.0, 1.0); }

#endif
