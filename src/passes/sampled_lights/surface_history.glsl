// What is kept of the surface behind a pixel's history, in one texel of RGBA32UI: distance along the camera's forward
// axis (0: none), normal, material, and the mean square of the luminance that was gathered there.
#ifndef LIGHTWELL_SURFACE_HISTORY_GLSL
#define LIGHTWELL_SURFACE_HISTORY_GLSL

#include "shaders/octahedral.glsl"

struct SurfaceHistory {
  float distance;
  vec3 normal;
  uint material;
  float mean_square;
};

uvec4 pack_surface(SurfaceHistory s) {
  return uvec4(floatBitsToUint(s.distance), packSnorm2x16(to_octahedron(s.normal)), s.material, floatBitsToUint(s.mean_square));
}

SurfaceHistory unpack_surface(uvec4 texel) {
  return SurfaceHistory(uintBitsToFloat(texel.x), from_octahedron(unpackSnorm2x16(texel.y)), texel.z, uintBitsToFloat(texel.w));
}

#endif
